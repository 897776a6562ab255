#include "core/live/log_replay.h"

#include <cmath>
#include <utility>

#include "core/live/session.h"
#include "core/live/undo.h"

namespace btr {

LogReplay::LogReplay(SessionLog log, long from) : log_(std::move(log)), from_(from), sameUntil_(from) {}

bool LogReplay::act(Session& session, const std::function<void(long, const std::string&)>& marked) {
  const long now = session.periods();
  bool changed = false;
  for (;;) {
    if (nextMark_ < log_.marks.size() && log_.marks[nextMark_].acts <= nextAct_ &&
        log_.marks[nextMark_].period <= now) {
      const std::string mark = session.mark();
      marked(now, mark);
      compare(log_.marks[nextMark_++], mark);
    } else if (nextAct_ < log_.acts.size() && log_.acts[nextAct_].period <= now) {
      const Act& act = log_.acts[nextAct_++].act;
      session.apply(act);
      changed |= std::holds_alternative<ParameterAct>(act) || std::holds_alternative<ControllerAct>(act) ||
                 std::holds_alternative<NumberAct>(act) || std::holds_alternative<EffectAct>(act) ||
                 std::holds_alternative<SimulatorAct>(act);
    } else {
      return changed;
    }
  }
}

bool LogReplay::isOver(const Session& session) const {
  return nextAct_ >= log_.acts.size() && nextMark_ >= log_.marks.size() && session.periods() >= log_.periods;
}

void LogReplay::returnTo(const Place& place) {
  sameUntil_ = place.sameUntil;
  differsBy_ = place.differsBy;
  nextAct_ = place.nextAct;
  nextMark_ = place.nextMark;
}

void LogReplay::compare(const SessionLog::Mark& was, const std::string& mark) {
  if (differsBy_) return;
  if (was.mark == mark)
    sameUntil_ = was.period;
  else
    differsBy_ = was.period;
}

std::vector<NamedActs> actsOf(const SessionLog& log, double period_s) {
  constexpr double together_s = 0.25;
  const long near = std::lround(together_s / period_s);
  std::vector<NamedActs> acts;
  for (const SessionLog::Entry& entry : log.acts) {
    const std::string name = nameOf(entry.act);
    if (!acts.empty() && acts.back().name == name && entry.period - acts.back().to <= near)
      acts.back().to = entry.period;
    else
      acts.push_back({entry.period, entry.period, name});
  }
  return acts;
}

}  // namespace btr
