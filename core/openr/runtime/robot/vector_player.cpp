#include "core/openr/runtime/robot/vector_player.h"

#include <algorithm>

#include "core/openr/runtime/objects/objcomm.h"

namespace btr::openr {

OStatus SyncKeys::make(OVRSyncKey* key) {
  std::set<int> all;
  for (const auto& [part, family] : families_) all.insert(family);
  if (all.size() >= ovrsynckeyMAX_NUM_KEY) return oNO_SYNC_KEY;
  *key = next_++;
  families_[*key] = nextFamily_++;
  return oSUCCESS;
}

OStatus SyncKeys::divide(OVRSyncKey key, OVRSyncKey* first, OVRSyncKey* second) {
  const auto at = families_.find(key);
  if (at == families_.end()) return oINVALID_SYNC_KEY;
  const int family = at->second;
  const auto parts =
      std::count_if(families_.begin(), families_.end(), [&](const auto& k) { return k.second == family; });
  if (static_cast<std::size_t>(parts) >= ovrsynckeyMAX_NUM_DIVISION) return oNO_SYNC_KEY;
  families_.erase(at);
  *first = next_++;
  *second = next_++;
  families_[*first] = families_[*second] = family;
  return oSUCCESS;
}

OStatus SyncKeys::cancel(OVRSyncKey key) { return families_.erase(key) > 0 ? oSUCCESS : oINVALID_SYNC_KEY; }

std::set<OVRSyncKey> SyncKeys::takeComplete(const std::set<OVRSyncKey>& waiting) {
  std::set<int> incomplete;
  for (const auto& [key, family] : families_)
    if (waiting.count(key) == 0) incomplete.insert(family);
  std::set<OVRSyncKey> complete;
  for (auto at = families_.begin(); at != families_.end();) {
    if (incomplete.count(at->second) > 0) {
      ++at;
      continue;
    }
    complete.insert(at->first);
    at = families_.erase(at);
  }
  return complete;
}

void VectorPlayer::take(ONotifyMessage& message) {
  const int count = message.numData;
  message.numData = 0;
  for (int i = 0; i < count; ++i) {
    Vector vector;
    vector.from = message.subject;
    vector.region = message.data[i];
    const auto queue =
        std::find_if(queues_.begin(), queues_.end(), [&](const Queue& q) { return q.from == message.subject; });
    if (queue == queues_.end()) {
      vector.region->RemoveReference();
      continue;
    }
    const bool large = vector.region->Size() >= sizeof(ODataVectorInfo);
    if (!large)
      complain_(vector.from, "region",
                "a region of " + std::to_string(vector.region->Size()) +
                    " bytes was sent to the robot: a vector begins with " + std::to_string(sizeof(ODataVectorInfo)));
    if (!large || !read(vector)) {
      sendReady(queue->from, id_, objcommASSERT_READY, {vector.region});
      continue;
    }
    queue->vectors.push_back(std::move(vector));
  }
}

void VectorPlayer::begin() {
  for (const Queue& queue : queues_) sendReady(queue.from, id_, objcommASSERT_READY, {});
}

void VectorPlayer::addWaiting(std::set<OVRSyncKey>& keys, const SyncKeys& known) const {
  for (const Queue& queue : queues_) {
    if (queue.vectors.empty()) continue;
    const Vector& first = queue.vectors.front();
    if (!first.started && first.wait == 0 && known.known(first.key)) keys.insert(first.key);
  }
}

void VectorPlayer::step(const std::set<OVRSyncKey>& starting, const SyncKeys& known) {
  for (Queue& queue : queues_) {
    if (queue.vectors.empty()) continue;
    Vector& vector = queue.vectors.front();
    if (!vector.started) {
      if (vector.wait > 0) {
        --vector.wait;
        continue;
      }
      if (known.known(vector.key) && starting.count(vector.key) == 0) continue;
      vector.started = true;
    }
    play(vector);
    if (++vector.frame < vector.length) continue;
    RCRegion* done = vector.region;
    queue.vectors.pop_front();
    sendReady(queue.from, id_, objcommASSERT_READY, {done});
  }
}

}  // namespace btr::openr
