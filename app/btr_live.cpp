// btr live: a running world without a window.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/btr_commands.h"
#include "app/btr_live_camera.h"
#include "app/btr_live_steering.h"
#include "core/live/session.h"
#include "core/live/session_log.h"
#include "core/sim/model_losses.h"
#include "core/sim/trace.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

struct LiveArguments {
  std::string game, replay, log, csv, save;
  double seconds = 10, speed = 0, patience_s = 2;
  bool steered = false;
  LiveCameraOptions camera;
};

std::string notAnswered(const std::string& who, double seconds) {
  return who + " has not answered for " + toText(std::round(10 * seconds) / 10) + " s";
}

/// Tells of a controller that hangs, and ends the program when it hangs on: a thread of it cannot be taken from it. The
/// log is complete up to the last act.
std::unique_ptr<Watchdog> watchdogOf(const LiveArguments& arguments, bool json) {
  const bool steered = arguments.steered;
  const double patience_s = arguments.patience_s;
  const auto hangs = [steered, patience_s](const std::string& who, double) {
    const std::string text = notAnswered(who, patience_s);
    std::fprintf(stderr, "%s\n", text.c_str());
    if (steered) tellLine({{"hangs", text}});
  };
  const auto gaveUp = [steered, json](const std::string& who, double seconds) {
    const std::string text = notAnswered(who, seconds);
    std::fprintf(stderr, "the world stopped: %s\n", text.c_str());
    if (steered || json) tellLine({{"fault", text}});
    std::_Exit(badInput);
  };
  return std::make_unique<Watchdog>(patience_s, hangs, gaveUp);
}

/// The periods of a session, its acts from a log, its rows for a file.
class LiveRun {
 public:
  LiveRun(const LiveArguments& arguments, Game game, const PluginHost& host, bool json)
      : arguments_(arguments),
        begun_(game),
        dog_(watchdogOf(arguments, json)),
        session_(std::move(game), host, dog_.get()) {
    if (!arguments.replay.empty()) {
      replayed_ = loadSessionLog(arguments.replay);
      if (replayed_->gameSha256 != gameSha256(begun_))
        throw InputError(arguments.replay, "it began with another game", "the log of a session of " + arguments.game);
    }
    if (!arguments.log.empty()) {
      written_ = std::make_unique<SessionLogWriter>(arguments.log, begun_);
      session_.onAct([this](long period, const Act& act) { written_->act(period, act); });
    }
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
    LiveSteering(session_, [this](const std::string& path) { save(path); }).run(stop);
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
      session_.step();
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
    const std::string sha = session_.traceSha256();
    if (written_) written_->end(session_.periods(), sha);
    if (!arguments_.csv.empty()) writeOut(arguments_.csv, trace_.toCsv());
    if (camera_) camera_->finish();
    nlohmann::json result{{"trace_sha256", sha},
                          {"simulated_s", simulated_},
                          {"real_time_factor", seconds_ > 0 ? simulated_ / seconds_ : 0},
                          {"periods", session_.periods()},
                          {"fault", session_.fault()}};
    if (session_.referee()) addReferee(session_, result, 0);
    if (replayed_ && !replayed_->traceSha256.empty() && session_.periods() == replayed_->periods)
      result["identical"] = sha == replayed_->traceSha256;
    return result;
  }

 private:
  void save(const std::string& path) {
    writeFile(path, toJsonText(movedTo(session_.save(), std::filesystem::path(path).parent_path().string())));
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
  Game begun_;
  std::unique_ptr<Watchdog> dog_;
  Session session_;
  std::optional<SessionLog> replayed_;
  std::unique_ptr<SessionLogWriter> written_;
  std::unique_ptr<LiveCamera> camera_;
  Trace trace_;
  std::size_t next_ = 0;
  double seconds_ = 0, simulated_ = 0;
};

}  // namespace

void addLiveCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<LiveArguments>();
  CLI::App* live = app.add_subcommand("live", "a running world: a game, a scene, or a robot on a floor");
  live->add_option("game", a->game, "game or scene (*.json), robot (*.wrl, *.urdf)")
      ->required()
      ->check(CLI::ExistingFile);
  CLI::Option* seconds = live->add_option("--seconds", a->seconds, "how long, simulated [s]")
                             ->transform(decimalNumber(0, 1e6))
                             ->capture_default_str();
  live->add_option("--speed", a->speed, "simulated seconds a second; 0: as fast as possible")
      ->transform(decimalNumber(0, 1000))
      ->capture_default_str();
  live->add_option("--replay", a->replay, "log of a session of this game, to be played again")
      ->check(CLI::ExistingFile);
  shell.writesFile(live, live->add_option("--log", a->log, "writes what reached into the session"));
  shell.writesFile(live, live->add_option("--csv", a->csv, "writes its trace as a recording"));
  addCameraOptions(*live, a->camera, shell);
  shell.writesFile(live, live->add_option("--save", a->save, "writes the game as it is at the end"));
  live->add_option("--patience", a->patience_s, "how long a controller may take for one control period [s]")
      ->transform(decimalNumber(0.01, 1e6))
      ->capture_default_str();
  live->add_flag("--steered", a->steered, "obeys lines of JSON on standard input, answers on standard output")
      ->excludes(seconds);
  live->callback([a, seconds, &shell] {
    Game game = loadGame(a->game);
    const ModelSet models = loadModels(game.scene);
    for (const std::string& loss : modelLosses(game.scene, models)) std::fprintf(stderr, "%s\n", loss.c_str());
    LiveRun run(*a, std::move(game), shell.plugins(), shell.json);
    if (a->steered) {
      run.steer(*shell.stop);
      run.finish();
      return;
    }
    run.run(run.wanted(seconds->count() > 0), *shell.stop);
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
    if (!fault.empty() || differs)
      shell.exitCode = badInput;
    else if (*shell.stop)
      shell.exitCode = stoppedEarly;
  });
}

}  // namespace btr::cli
