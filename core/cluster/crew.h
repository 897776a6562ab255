#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/cluster/parts.h"

namespace btr {

/// How a foreman is started: the program and its arguments.
using ForemanCommand = std::vector<std::string>;
/// This program's own: "btr pieces".
ForemanCommand ownForeman();

/// The foremen of one rank, numbered from 0: processes that work on pieces (foreman.h). One that ends, in whatever way,
/// is started anew at once. Belongs to one thread.
class Crew {
 public:
  /// A foreman's message, or "lost WHY" when it ended: what it had to do is undone, and a new one begins with "hello".
  /// "gone WHY" when it ended several times without a result: it is not started any more.
  struct Event {
    int foreman = 0;
    Parts parts;
  };

  /// Throws InputError if none can be started.
  Crew(int foremen, ForemanCommand command);
  /// Ends them at once.
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  int size() const;
  void send(int foreman, const Parts& parts);
  /// Ends one that no longer answers, whose "lost" follows.
  void restart(int foreman);
  /// What has arrived, after at most so long (0: what is there).
  std::vector<Event> wait(std::chrono::microseconds most);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
