#pragma once
#include <functional>
#include <optional>

#include "core/live/session_log.h"

namespace btr {

class Session;

/// A session's log that is played again with another session of its game, and whether that one is the same.
class LogReplay {
 public:
  /// The session that it is played with begins where the log's did.
  LogReplay(SessionLog log, long from);

  const SessionLog& log() const { return log_; }
  long from() const { return from_; }
  /// Applies what is due before the session's next period, and compares where the log was marked; `marked` is told of
  /// each mark that was made for that. Says whether that changed which numbers the game has: parameters, controllers,
  /// simulators.
  bool act(Session& session, const std::function<void(long period, const std::string& mark)>& marked);
  /// Where neither act nor mark is left and the session has gone as far as the logged one.
  bool isOver(const Session& session) const;

  /// How far it has been played, to come back to.
  struct Place {
    long sameUntil = 0;
    std::optional<long> differsBy{};
    std::size_t nextAct = 0, nextMark = 0;
  };
  Place place() const { return {sameUntil_, differsBy_, nextAct_, nextMark_}; }
  void returnTo(const Place& place);

  /// Without marks, nothing is known before the end.
  bool hasMarks() const { return !log_.marks.empty(); }
  /// Before this period the sessions were surely the same: their marks were.
  long sameUntil() const { return sameUntil_; }
  /// Before this period they were not, and the mark before was still the same.
  std::optional<long> differsBy() const { return differsBy_; }

 private:
  void compare(const SessionLog::Mark& was, const std::string& mark);

  SessionLog log_;
  long from_, sameUntil_;
  std::optional<long> differsBy_;
  std::size_t nextAct_ = 0, nextMark_ = 0;
};

/// What a log's acts were, for a line of time: those of the same name that follow each other within a quarter of a
/// second are one.
struct NamedActs {
  long from, to;  ///< periods
  std::string name;
};
std::vector<NamedActs> actsOf(const SessionLog& log, double period_s);

}  // namespace btr
