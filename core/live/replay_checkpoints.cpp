#include "core/live/replay_checkpoints.h"

#include <algorithm>
#include <utility>

#include "core/live/session.h"

namespace btr {

ReplayCheckpoints::ReplayCheckpoints(long first, std::size_t most) : interval_(first), most_(most) {}

bool ReplayCheckpoints::pass(const Session& session, const LogReplay& replay, long written, long marked) {
  const long now = session.periods();
  const auto at = std::ranges::lower_bound(kept_, now, {}, [](const Kept& kept) { return kept.session.periods; });
  if (at != kept_.end() && at->session.periods == now) {
    // Not gone back, or what the log has here is done already.
    if (!returned_ || now <= returnedTo_ || replay.place().nextAct != at->replay.nextAct) return true;
    if (at->session.traceSha256() == session.traceSha256SoFar()) {
      proven_ = true;
      return true;
    }
    trusted_ = false;
    kept_.erase(kept_.begin() + 1, kept_.end());
    return false;
  }
  const bool start = now == replay.from();
  if (at != kept_.end() || (!start && (!trusted_ || kept_.empty() || (now - replay.from()) % interval_ != 0)))
    return true;
  std::optional<SessionCheckpoint> checkpoint = session.checkpoint();
  if (!checkpoint) return true;
  kept_.push_back({std::move(*checkpoint), replay.place(), written, marked});
  if (kept_.size() <= most_ + 1) return true;
  interval_ *= 2;
  std::erase_if(kept_, [&](const Kept& kept) { return (kept.session.periods - replay.from()) % interval_ != 0; });
  return true;
}

const ReplayCheckpoints::Kept* ReplayCheckpoints::goBack(long period) {
  const auto after = std::ranges::upper_bound(kept_, period, {}, [](const Kept& kept) { return kept.session.periods; });
  auto count = after - kept_.begin();
  if (count == 0) return nullptr;
  if (!proven_ && count > 1) --count;
  const Kept& kept = kept_[static_cast<std::size_t>(count - 1)];
  returned_ = true;
  returnedTo_ = kept.session.periods;
  return &kept;
}

}  // namespace btr
