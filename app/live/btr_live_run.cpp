#include "app/live/btr_live_run.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/live/btr_camera_eye.h"
#include "app/live/btr_live_steering.h"
#include "app/openr/btr_openr_robots.h"
#include "core/live/moment.h"
#include "core/live/session.h"
#include "core/live/session_log.h"
#include "core/sim/model_losses.h"
#include "core/sim/trace.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

std::string notAnswered(const std::string& who, double seconds) {
  return who + " has not answered for " + toText(std::round(10 * seconds) / 10) + " s";
}

Watchdog::Teller tellsOfHanging(const LiveArguments& arguments) {
  return [steered = arguments.steered, patience_s = arguments.patience_s](const std::string& who, double) {
    const std::string text = notAnswered(who, patience_s);
    std::fprintf(stderr, "%s\n", text.c_str());
    if (steered) tellLine({{"hangs", text}});
  };
}

/// Tells of a controller that hangs, and ends the program when it hangs on: a thread of it cannot be taken from it. The
/// log is complete up to the last act.
std::unique_ptr<Watchdog> watchdogOf(const LiveArguments& arguments, bool json) {
  const bool steered = arguments.steered;
  const auto gaveUp = [steered, json](const std::string& who, double seconds) {
    const std::string text = notAnswered(who, seconds);
    std::fprintf(stderr, "the world stopped: %s\n", text.c_str());
    if (steered || json) tellLine({{"fault", text}});
    std::_Exit(badInput);
  };
  return std::make_unique<Watchdog>(arguments.patience_s, tellsOfHanging(arguments), gaveUp);
}

/// The periods of a session, its acts from a log, its rows for a file.
class LiveRun {
 public:
  LiveRun(const LiveArguments& arguments, Game game, const PluginHost& host, bool json)
      : arguments_(arguments),
        json_(json),
        begun_(game),
        dog_(watchdogOf(arguments, json)),
        programDog_(std::make_unique<Watchdog>(arguments.patience_s, tellsOfHanging(arguments),
                                               [](const auto&, double) {
                                                 // Its process is ended by whoever started it: the world goes on.
                                               })),
        session_(std::move(game), host, dog_.get(), cameraMaker()) {
    if (!arguments.replay.empty()) {
      replayed_ = loadSessionLog(arguments.replay);
      if (replayed_->gameSha256 != gameSha256(begun_))
        throw InputError(arguments.replay, "it began with another game", "the log of a session of " + arguments.game);
    }
    if (!arguments.log.empty()) written_ = std::make_unique<SessionLogWriter>(arguments.log, begun_);
    session_.onAct([this](long period, const Act& act) {
      if (written_) written_->act(period, act);
      if (openr_) openr_->acted(act);
    });
    for (const OpenrChoice& choice : arguments.sticks)
      session_.apply(ControllerAct{choice.robot, controllerOf(choice)});
    // What programs did stands in the log that is played again.
    if (!replayed_) openr_ = std::make_unique<OpenrRobots>(session_, programDog_.get());
    if (openr_ && arguments.strict)
      if (const std::vector<std::string> failures = openr_->failures(); !failures.empty())
        throw InputError(failures.front());
    if (!arguments.csv.empty()) {
      trace_.channels = session_.channels();
      session_.sample(trace_.values);
    }
    if (!arguments.camera.robot.empty()) camera_ = std::make_unique<LiveCamera>(arguments.camera, session_);
  }

  long wanted(bool secondsGiven) const {
    const long from = session_.periods();
    if (replayed_ && !secondsGiven) return replayed_->periods;
    return from + std::lround(arguments_.seconds / session_.game().scene.controlPeriod_s);
  }

  /// By lines on standard input.
  void steer(const std::atomic<bool>& stop) {
    LiveSteering(session_, *openr_, [this](const std::string& path) { save(path); }).run(stop);
  }

  void run(long until, const std::atomic<bool>& stop) {
    const long from = session_.periods();
    const auto begin = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    while (session_.fault().empty() && !stop) {
      act();
      if (session_.periods() >= until) break;
      if (openr_) openr_->step();
      session_.step();
      tellConsole();
      if (!arguments_.csv.empty() && session_.fault().empty()) sample();
      if (camera_ && session_.fault().empty()) camera_->tell(session_);
      if (arguments_.speed <= 0) continue;
      const double due =
          static_cast<double>(session_.periods() - from) * session_.game().scene.controlPeriod_s / arguments_.speed;
      std::this_thread::sleep_for(std::chrono::duration<double>(std::max(0.0, due - elapsed())));
    }
    seconds_ = elapsed();
    simulated_ = static_cast<double>(session_.periods() - from) * session_.game().scene.controlPeriod_s;
  }

  nlohmann::json finish() {
    if (!arguments_.save.empty()) save(arguments_.save);
    if (!arguments_.saveScene.empty()) saveScene(arguments_.saveScene);
    if (openr_) openr_->end();
    tellConsole();
    const std::string sha = session_.traceSha256();
    if (written_) written_->end(session_.periods(), sha);
    if (!arguments_.csv.empty()) writeOut(arguments_.csv, trace_.toCsv());
    if (camera_) camera_->finish();
    nlohmann::json result{{"trace_sha256", sha},
                          {"simulated_s", simulated_},
                          {"real_time_factor", seconds_ > 0 ? simulated_ / seconds_ : 0},
                          {"periods", session_.periods()},
                          {"fault", session_.fault()}};
    if (openr_)
      if (nlohmann::json states = openr_->states(); !states.empty()) result["programs"] = std::move(states);
    if (session_.referee()) addReferee(session_, result, 0);
    if (replayed_ && !replayed_->traceSha256.empty() && session_.periods() == replayed_->periods)
      result["identical"] = sha == replayed_->traceSha256;
    return result;
  }

  std::vector<std::string> programFailures() const { return openr_ ? openr_->failures() : std::vector<std::string>{}; }

 private:
  static GameController controllerOf(const OpenrChoice& choice) {
    GameController controller;
    controller.openr = choice.stick;
    return controller;
  }

  /// A steered session tells its lines itself.
  void tellConsole() {
    if (!openr_ || arguments_.steered) return;
    for (const openr::LivePrograms::Line& line : openr_->takeLines())
      std::fprintf(json_ ? stderr : stdout, "%s\n", textOf(line).c_str());
    if (!json_) std::fflush(stdout);
  }

  void save(const std::string& path) {
    writeFile(path, toJsonText(movedTo(session_.save(), std::filesystem::path(path).parent_path().string())));
  }

  void saveScene(const std::string& path) {
    Game moment;
    moment.scene = momentOf(session_);
    writeFile(path, toJsonText(movedTo(std::move(moment), std::filesystem::path(path).parent_path().string()).scene));
  }

  void act() {
    if (!replayed_) return;
    while (next_ < replayed_->acts.size() && replayed_->acts[next_].period <= session_.periods())
      session_.apply(replayed_->acts[next_++].act);
  }

  void sample() {
    if (session_.channels() != trace_.channels)
      throw InputError(arguments_.csv, "objects came or went",
                       "a session with the same objects from its start to its end");
    session_.sample(trace_.values);
  }

  const LiveArguments& arguments_;
  bool json_;
  Game begun_;
  std::unique_ptr<Watchdog> dog_, programDog_;
  Session session_;
  std::optional<SessionLog> replayed_;
  std::unique_ptr<SessionLogWriter> written_;
  std::unique_ptr<OpenrRobots> openr_;  ///< none while a log is played again
  std::unique_ptr<LiveCamera> camera_;
  Trace trace_;
  std::size_t next_ = 0;
  double seconds_ = 0, simulated_ = 0;
};

}  // namespace

void runLive(const LiveArguments& arguments, bool secondsGiven, Shell& shell) {
  Game game = loadGame(arguments.game);
  const ModelSet models = loadModels(game.scene);
  for (const std::string& loss : modelLosses(game.scene, models)) std::fprintf(stderr, "%s\n", loss.c_str());
  LiveRun run(arguments, std::move(game), shell.plugins(), shell.json);
  if (arguments.steered) {
    run.steer(*shell.stop);
    run.finish();
    return;
  }
  run.run(run.wanted(secondsGiven), *shell.stop);
  const nlohmann::json result = run.finish();
  const std::string fault = result["fault"];
  const bool differs = result.contains("identical") && !result["identical"].get<bool>();
  if (shell.json) {
    printJson(result);
  } else {
    std::cout << brief(result["simulated_s"]) << " s simulated, " << brief(result["real_time_factor"])
              << " times as fast as time\ntrace " << result["trace_sha256"].get<std::string>() << "\n";
    if (result.contains("score"))
      std::cout << "red " << result["score"][0] << ", blue " << result["score"][1] << ", half " << result["half"]
                << " at " << brief(result["clock_s"]) << " s\n";
    if (result.contains("identical"))
      std::cout << (differs ? "NOT identical to the log's\n" : "identical to the log's\n");
  }
  if (!fault.empty()) std::fprintf(stderr, "the world stopped: %s\n", fault.c_str());
  const std::vector<std::string> failures = run.programFailures();
  for (const std::string& failure : failures) std::fprintf(stderr, "%s\n", printable(failure).c_str());
  if (!fault.empty() || differs || !failures.empty())
    shell.exitCode = badInput;
  else if (*shell.stop)
    shell.exitCode = stoppedEarly;
}

}  // namespace btr::cli
