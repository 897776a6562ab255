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
#include "core/live/log_replay.h"
#include "core/live/moment.h"
#include "core/live/moment_experiment.h"
#include "core/live/replay_checkpoints.h"
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
  LiveRun(const LiveArguments& arguments, Game game, std::optional<SessionLog> log, const PluginHost& host, bool json)
      : arguments_(arguments),
        host_(host),
        json_(json),
        begun_(game),
        dog_(watchdogOf(arguments, json)),
        programDog_(std::make_unique<Watchdog>(arguments.patience_s, tellsOfHanging(arguments),
                                               [](const auto&, double) {
                                                 // Its process is ended by whoever started it: the world goes on.
                                               })),
        session_(std::move(game), host, dog_.get(), cameraMaker()) {
    if (log) {
      if (log->gameSha256 != gameSha256(begun_))
        throw InputError(arguments.replay, "it began with another game", "the log of a session of " + arguments.game);
      replay_ = std::make_unique<LogReplay>(std::move(*log), session_.periods());
    }
    if (!arguments.log.empty())
      writeLog([this] { written_ = std::make_unique<SessionLogWriter>(arguments_.log, begun_); });
    session_.onAct([this](long period, const Act& act) {
      if (written_) writeLog([&] { written_->act(period, act); });
      if (openr_) openr_->acted(act);
    });
    for (const OpenrChoice& choice : arguments.sticks)
      session_.apply(ControllerAct{choice.robot, controllerOf(choice)});
    // What programs did stands in the log that is played again.
    if (!replay_) openr_ = std::make_unique<OpenrRobots>(session_, programDog_.get());
    if (openr_ && arguments.strict)
      if (const std::vector<std::string> failures = openr_->failures(); !failures.empty())
        throw InputError(failures.front());
    if (!arguments.steered)
      for (const std::string& overlap : overlapsIn(session_)) std::fprintf(stderr, "%s\n", overlap.c_str());
    if (!arguments.csv.empty()) {
      trace_.channels = session_.channels();
      session_.sample(trace_.values);
    }
    if (!arguments.camera.robot.empty()) camera_ = std::make_unique<LiveCamera>(arguments.camera, session_);
  }

  long wanted(bool secondsGiven) const {
    const long from = session_.periods();
    const double period_s = session_.game().scene.controlPeriod_s;
    const double from_s = static_cast<double>(from) * period_s;
    if (arguments_.until_s && *arguments_.until_s < from_s)
      throw InputError("--until", toText(*arguments_.until_s) + " s", "at least " + toText(from_s) + " s, the start");
    if (arguments_.until_s && replay_ && *arguments_.until_s > static_cast<double>(replay_->log().periods) * period_s)
      throw InputError("--until", toText(*arguments_.until_s) + " s",
                       "at most " + toText(static_cast<double>(replay_->log().periods) * period_s) + " s, where " +
                           arguments_.replay + " ends");
    if (arguments_.until_s) return std::lround(*arguments_.until_s / period_s);
    if (replay_ && !secondsGiven) return replay_->log().periods;
    return from + std::lround(arguments_.seconds / period_s);
  }

  /// By lines on standard input.
  void steer(const std::atomic<bool>& stop) {
    LiveSteering::Work work;
    work.step = [this] { step(); };
    work.act = [this] { return act(); };
    work.save = [this](const std::string& path) { save(path); };
    work.saveScene = [this](const std::string& path) { saveScene(path); };
    work.saveExperiment = [this](const std::string& path, const std::string& robot) {
      writeExperiment(experimentOf(session_, host_, robot), path);
    };
    work.programs = [this] { return openr_.get(); };
    work.replay = [this] { return replay_.get(); };
    work.goOn = [this] { goOn(); };
    work.goesBack = [this] { return replay_ && session_.checkpoint().has_value(); };
    work.goBack = [this](long period) { return goBack(period); };
    checkpoints_.emplace();
    LiveSteering(session_, std::move(work)).run(stop);
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
      step();
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
    if (!arguments_.saveExperiment.empty())
      writeExperiment(experimentOf(session_, host_, arguments_.learner), arguments_.saveExperiment);
    if (openr_) openr_->end();
    tellConsole();
    if (session_.periods() != marked_) keepMark(session_.periods(), session_.mark());
    const std::string sha = session_.traceSha256();
    if (written_) writeLog([&] { written_->end(session_.periods(), sha); });
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
    if (replay_) tellSameness(result, sha);
    return result;
  }

  std::vector<std::string> programFailures() const { return openr_ ? openr_->failures() : std::vector<std::string>{}; }

 private:
  /// One control period on.
  void step() {
    if (openr_) openr_->step();
    const long before = session_.periods();
    session_.step();
    const long now = session_.periods();
    if (now != before && now % SessionLog::markEvery == 0 && !(replay_ && replay_->hasMarks()))
      keepMark(now, session_.mark());
  }

  /// A world that somebody steers goes on where its log has no more room: the log ends with its last whole line, and
  /// that is told once. Others end with it.
  void writeLog(const std::function<void()>& work) {
    try {
      work();
    } catch (const InputError& error) {
      if (!arguments_.steered) throw;
      written_.reset();
      tellLine({{"log_lost", error.what()}});
    }
  }

  void keepMark(long period, const std::string& mark) {
    marked_ = period;
    if (written_) writeLog([&] { written_->mark(period, mark); });
  }

  /// What the log that is played again has here; true if the game's numbers are others now.
  bool act() {
    if (!replay_) return false;
    const long written = written_ ? written_->place() : 0;
    bool changed = false;
    if (checkpoints_ && !checkpoints_->pass(session_, *replay_, written, marked_)) {
      // Where it was gone back to, it did not go on as before: what it shows is made anew.
      const long period = session_.periods();
      changed = goBack(replay_->from());
      while (session_.periods() < period && session_.fault().empty()) {
        act();
        step();
      }
    }
    return replay_->act(session_, [this](long period, const std::string& mark) { keepMark(period, mark); }) || changed;
  }

  /// To the last checkpoint before that period; false where there is none.
  bool goBack(long period) {
    const ReplayCheckpoints::Kept* kept = replay_ && checkpoints_ ? checkpoints_->goBack(period) : nullptr;
    if (!kept) return false;
    session_.returnTo(kept->session);
    replay_->returnTo(kept->replay);
    if (written_) writeLog([&] { written_->returnTo(kept->written); });
    marked_ = kept->marked;
    return true;
  }

  /// What is left of the log is given up: hands and programs have it from here.
  void goOn() {
    openr_ = std::make_unique<OpenrRobots>(session_, programDog_.get());
    replay_.reset();
    checkpoints_.reset();
  }

  void tellSameness(nlohmann::json& result, const std::string& sha) const {
    const SessionLog& log = replay_->log();
    if (!log.traceSha256.empty() && session_.periods() == log.periods) result["identical"] = sha == log.traceSha256;
    if (log.marks.empty()) return;
    result["identical_until"] = replay_->sameUntil();
    if (!replay_->differsBy()) return;
    result["differs_by"] = *replay_->differsBy();
    result["identical"] = false;
  }

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

  // A checkpoint would give a log that is played again other bits.
  void save(const std::string& path) {
    Game game = replay_ ? session_.saved() : session_.save();
    writeFile(path, toJsonText(movedTo(std::move(game), std::filesystem::path(path).parent_path().string())));
  }

  void saveScene(const std::string& path) {
    Game moment;
    moment.scene = momentOf(session_);
    writeFile(path, toJsonText(movedTo(std::move(moment), std::filesystem::path(path).parent_path().string()).scene));
  }

  void sample() {
    if (session_.channels() != trace_.channels)
      throw InputError(arguments_.csv, "objects came or went",
                       "a session with the same objects from its start to its end");
    session_.sample(trace_.values);
  }

  const LiveArguments& arguments_;
  const PluginHost& host_;
  bool json_;
  Game begun_;
  std::unique_ptr<Watchdog> dog_, programDog_;
  Session session_;
  std::unique_ptr<LogReplay> replay_;
  std::optional<ReplayCheckpoints> checkpoints_;  ///< while a log is played again and somebody may go back in it
  std::unique_ptr<SessionLogWriter> written_;
  std::unique_ptr<OpenrRobots> openr_;  ///< none while a log is played again
  std::unique_ptr<LiveCamera> camera_;
  Trace trace_;
  long marked_ = -1;  ///< the period of the last mark
  double seconds_ = 0, simulated_ = 0;
};

/// Where it is known.
std::string firstDifference(const nlohmann::json& result) {
  if (!result.contains("differs_by")) return {};
  return ": the first difference is between the steps " + result["identical_until"].dump() + " and " +
         result["differs_by"].dump();
}

/// What is wrong with the parts of a game together does not know its file.
std::string withFile(const std::string& file, const std::string& what) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  const bool hasPath = what.starts_with(file) || (!folder.empty() && what.starts_with(folder));
  return file.empty() || hasPath ? what : file + ": " + what;
}

}  // namespace

void runLive(const LiveArguments& arguments, bool secondsGiven, Shell& shell) {
  std::optional<SessionLog> log;
  if (!arguments.replay.empty()) log = loadSessionLog(arguments.replay);
  if (arguments.game.empty() && !log->game)
    throw InputError(arguments.replay, "its game is not in it",
                     "the game's file beside it: btr live GAME --replay LOG");
  Game game = arguments.game.empty() ? *log->game : loadGame(arguments.game);
  const ModelSet models = loadModels(game.scene);
  for (const std::string& loss : modelLosses(game.scene, models)) std::fprintf(stderr, "%s\n", loss.c_str());
  std::optional<LiveRun> begun;
  try {
    begun.emplace(arguments, std::move(game), std::move(log), shell.plugins(), shell.json);
  } catch (const InputError& error) {
    throw InputError(withFile(arguments.game, error.what()));
  }
  LiveRun& run = *begun;
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
      std::cout << (differs ? "NOT identical to the log's" + firstDifference(result) : "identical to the log's")
                << "\n";
    else if (result.contains("identical_until"))
      std::cout << "identical to the log's up to step " << result["identical_until"] << "\n";
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
