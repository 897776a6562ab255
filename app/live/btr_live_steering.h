#pragma once
#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/live/btr_live_signals.h"
#include "app/openr/btr_openr_robots.h"
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
  /// `save(path)` writes the game; what it throws as InputError is answered as a refusal.
  LiveSteering(Session& session, OpenrRobots& openr, std::function<void(const std::string& path)> save);
  void run(const std::atomic<bool>& stop);

 private:
  bool readInput(int wait_ms);
  void obey(const std::string& line);
  void advance();
  void stepOnce();
  void tellGame();
  void tellRow();
  void tellPrograms(nlohmann::json& line);
  void tellReferee(nlohmann::json& line);
  /// What can be undone and redone, if that is no longer what was told.
  void tellUndo();
  void act(JsonReader& reader);
  /// Changes the session, and tells what came of it; what is thrown as InputError is answered as a refusal.
  void change(const std::function<void()>& work);
  void chooseSignals(JsonReader& reader);
  int untilNext_ms() const;

  Session& session_;
  OpenrRobots& openr_;
  long programsTold_ = -1;  ///< OpenrRobots::changes()
  std::function<void(const std::string&)> save_;
  UndoStack undo_;
  std::string undoTold_, redoTold_;
  LiveSignals signals_;
  std::vector<double> sampled_;  ///< one row
  std::string pending_;          ///< of standard input, without its last line's end
  bool playing_ = false, ended_ = false;
  bool over_ = false;       ///< the referee's game
  long eventsTold_ = 0;     ///< of the referee
  double speed_ = 1;        ///< simulated seconds a second; 0: as fast as possible
  double anchor_s_ = 0;     ///< wall time …
  long anchorPeriods_ = 0;  ///< … at which this period was due
  double measuredFrom_s_ = 0, factor_ = 0;
  long measuredPeriods_ = 0;
  double nextRow_s_ = 0;
};

/// Score, clock, half and the referee's events after the first `from`.
void addReferee(const Session& session, nlohmann::json& line, long from);

/// One line of standard output, from any thread.
void tellLine(const nlohmann::json& line);

}  // namespace btr::cli
