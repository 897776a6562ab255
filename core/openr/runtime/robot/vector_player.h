#pragma once
#include <OPENR/ODataFormats.h>
#include <OPENR/ObjcommTypes.h>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace btr::openr {

/// Keys that let vectors start together: a new key may be divided again and again; what starts together are all the
/// parts that were not divided further.
class SyncKeys {
 public:
  OStatus make(OVRSyncKey* key);
  OStatus divide(OVRSyncKey key, OVRSyncKey* first, OVRSyncKey* second);
  OStatus cancel(OVRSyncKey key);
  /// Of these keys that wait, those whose whole family waits; the families are used up by it.
  std::set<OVRSyncKey> takeComplete(const std::set<OVRSyncKey>& waiting);
  bool known(OVRSyncKey key) const { return families_.count(key) > 0; }

 private:
  std::map<OVRSyncKey, int> families_;  ///< of each part that is not divided
  OVRSyncKey next_ = 1;
  int nextFamily_ = 1;
};

/// Plays the vectors of several subjects, each subject's one after the other, in frames of 8 ms. Whoever sent one is
/// told that more is wanted when it has been played.
class VectorPlayer {
 public:
  /// Told what is wrong with a vector of a subject, and of which kind that is.
  using Complain = std::function<void(const SubjectID& from, const std::string& kind, const std::string& text)>;

  VectorPlayer(const ObserverID& id, Complain complain) : complain_(std::move(complain)), id_(id) {}
  virtual ~VectorPlayer() = default;

  void connect(const SubjectID& subject) { queues_.push_back({subject, {}}); }
  /// Takes over the regions of the message.
  void take(ONotifyMessage& message);
  /// Wants the first vector of every subject.
  void begin();
  /// Keys of the vectors that could start now.
  void addWaiting(std::set<OVRSyncKey>& keys, const SyncKeys& known) const;
  /// One frame. Vectors with a key start if it is among `starting`, or is none that anybody made.
  void step(const std::set<OVRSyncKey>& starting, const SyncKeys& known);

 protected:
  struct Vector {
    SubjectID from;
    RCRegion* region = nullptr;
    longword wait = 0;
    OVRSyncKey key = ovrsynckeyUNDEF;
    bool started = false;
    std::size_t frame = 0, length = 1;
    std::shared_ptr<void> content;
  };
  /// Reads what the region holds into content and length. False if it is no vector of this kind.
  virtual bool read(Vector& vector) = 0;
  /// Frame `vector.frame` begins.
  virtual void play(const Vector& vector) = 0;

  const Complain complain_;

 private:
  struct Queue {
    SubjectID from;
    std::deque<Vector> vectors;
  };
  ObserverID id_;
  std::vector<Queue> queues_;
};

}  // namespace btr::openr
