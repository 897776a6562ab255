#pragma once
#include <optional>
#include <vector>

#include "core/live/log_replay.h"
#include "core/live/session_checkpoint.h"

namespace btr {

/// Moments of a session that plays a log again, so that going back need not begin at the log's start. They are few: at
/// intervals that double whenever there are too many. Coming back to one goes on with the same bits, which is checked
/// wherever the session passes a later one again: if a motion turns out to remember what it does not tell, only the
/// start is kept from then on.
class ReplayCheckpoints {
 public:
  struct Kept {
    SessionCheckpoint session;
    LogReplay::Place replay;
    long written = 0;  ///< what the owner needs of a log of its own, see pass()
    long marked = 0;
  };

  /// `first`: control periods between two of them; at most `most` beside the start.
  explicit ReplayCheckpoints(long first = 125, std::size_t most = 64);

  /// Before each control period, before what the log has there. False where the session is not what it was when it
  /// passed here before: then go back to the start, and from there on again.
  bool pass(const Session& session, const LogReplay& replay, long written, long marked);
  /// The last one at or before that period, to which the owner returns now; null where there is none (a controller
  /// looks: cameras cannot go back). As long as none was passed again, one earlier, so that one will be.
  const Kept* goBack(long period);
  std::size_t count() const { return kept_.size(); }

 private:
  long interval_;
  std::size_t most_;
  std::vector<Kept> kept_;  ///< by period
  long returnedTo_ = 0;     ///< period of the one that was last gone back to
  bool returned_ = false, trusted_ = true, proven_ = false;
};

}  // namespace btr
