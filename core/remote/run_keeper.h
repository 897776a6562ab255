#pragma once
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/remote/nursery.h"
#include "core/store/records.h"

namespace btr::remote {

/// What a run that is worked on says to whoever asks.
struct RunNews {
  enum class What { working, asks, finished, waiting, stopped, notHere };
  What what = What::working;
  long number = 0;       ///< of the question
  std::string question;  ///< JSON, see plugins/learners/remote.cpp
  std::string message;   ///< why it stopped
};

/// The runs that processes of this server work on, and the questions of their learners. From any thread.
class RunKeeper {
 public:
  static constexpr std::size_t most = 4;             ///< at a time
  static constexpr std::size_t mostRemembered = 16;  ///< that are over, with why

  explicit RunKeeper(Nursery& nursery) : nursery_(nursery) {}
  /// Ends the processes that are still there.
  ~RunKeeper() = default;
  RunKeeper(const RunKeeper&) = delete;
  RunKeeper& operator=(const RunKeeper&) = delete;

  /// One that is worked on already gets the patience, or keeps its own with 0. Throws Refusal, also for one that is
  /// still about to stop.
  void begin(Id run, double patience_s);
  bool isHere(Id run) const;
  /// end() was called, and its process is still there.
  bool isToStop(Id run) const;
  /// Waits for the end of a run whose process is about to leave, at most `patience_s`.
  void awaitEnd(Id run, double patience_s) const;
  /// Waits until there is something to say, at most `wait_s`, or until `cancelled`.
  RunNews news(Id run, double wait_s, const std::function<bool()>& cancelled);
  /// An answer to question `number`, JSON as the plugin wants it. Throws Refusal where it is not taken; an answer that
  /// was taken already is no error.
  void tell(Id run, long number, const std::string& answer);
  /// All runs stop: those that wait for their learner at once, of the others it is asked by `request`, and waited for
  /// until `patience_s` is over.
  void stopAll(const std::function<void(Id)>& request, double patience_s);
  /// The learner is asked no longer, now and from now on: its run stops, with why.
  void end(Id run, const std::string& why);

 private:
  struct Work;
  std::shared_ptr<Work> find(Id run) const;
  /// What its process said in the end.
  static Answer follow(Work& work);
  /// The oldest of those that are over, so that few stay. To be destroyed outside of the lock.
  std::vector<std::shared_ptr<Work>> takeForgotten();

  Nursery& nursery_;
  mutable std::mutex mutex_;
  std::map<Id, std::shared_ptr<Work>> works_;
  long begun_ = 0;
};

}  // namespace btr::remote
