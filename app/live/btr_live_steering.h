#pragma once
#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/live/btr_live_signals.h"
#include "app/openr/btr_openr_robots.h"
#include "core/live/log_replay.h"
#include "core/live/session.h"
#include "core/live/undo.h"

namespace btr {
class JsonReader;
}
namespace btr::cli {

/// A session that is steered by lines of JSON on standard input and tells what it does on standard output; see
/// manual/formats/game.md. Ends with standard input, with {"do": "end"}, or when `stop` is raised.
class LiveSteering {
 public:
  /// What is done with the session; what these throw as InputError is answered as a refusal.
  struct Work {
    std::function<void()> step;  ///< one control period
    /// What a log that is played again has before the next one; true if the game's numbers are others then.
    std::function<bool()> act;
    std::function<void(const std::string&path)> save, saveScene;
    std::function<void(const std::string& path, const std::string& robot)> saveExperiment;
    std::function<OpenrRobots*()> programs;  ///< null while a log is played again
    std::function<LogReplay*()> replay;      ///< null while hands are on
    std::function<void()> goOn;              ///< ends the replay
    std::function<bool()> goesBack;          ///< whether a replay can go back
    std::function<bool(long)> goBack;        ///< to that period or one before it; false where it cannot
  };
  LiveSteering(Session& session, Work work);
  void run(const std::atomic<bool>& stop);

 private:
  bool readInput(int wait_ms);
  void obey(const std::string& line);
  /// {"do": …}, all but undo and redo.
  void work(const std::string& wanted, JsonReader& reader);
  void advance();
  /// False where it cannot go on: a log's end, a world that stopped.
  bool stepOnce();
  /// Hands are off while a log is played again.
  void requireHands() const;
  void goTo(JsonReader& reader);
  void goBack(long period);
  void tellLog();
  void replayActs();
  void tellGame();
  void tellRow();
  void tellPrograms(nlohmann::json& line);
  void tellReferee(nlohmann::json& line);
  /// What can be undone and redone, if that is no longer what was told.
  void tellUndo();
  void act(JsonReader& reader);
  /// Changes the session, and tells what came of it; what is thrown as InputError is answered as a refusal.
  void change(const std::function<void()>& work);
  /// Where they are others than those that were told last.
  void tellOverlaps();
  void chooseSignals(JsonReader& reader);
  int untilNext_ms() const;

  Session& session_;
  Work work_;
  long programsTold_ = -1;  ///< OpenrRobots::changes()
  UndoStack undo_;
  std::string undoTold_, redoTold_;
  LiveSignals signals_;
  std::vector<double> sampled_;  ///< one row
  std::string pending_;          ///< of standard input, without its last line's end
  bool playing_ = false, ended_ = false;
  bool over_ = false;                      ///< the referee's game
  std::vector<std::string> overlapsTold_;  ///< last
  bool gameChanged_ = false;               ///< since it was told, by a log's acts
  std::optional<long> goal_;               ///< a period to which a log is played as fast as possible
  long acts_ = 0, undos_ = 0;              ///< that were read, refused ones too
  long eventsTold_ = 0;                    ///< of the referee
  double speed_ = 1;                       ///< simulated seconds a second; 0: as fast as possible
  double anchor_s_ = 0;                    ///< wall time …
  long anchorPeriods_ = 0;                 ///< … at which this period was due
  double measuredFrom_s_ = 0, factor_ = 0;
  long measuredPeriods_ = 0;
  double nextRow_s_ = 0;
};

/// Score, clock, half and the referee's events after the first `from`.
void addReferee(const Session& session, nlohmann::json& line, long from);

/// One line of standard output, from any thread.
void tellLine(const nlohmann::json& line);

}  // namespace btr::cli
