#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "core/remote/refusal.h"

namespace btr::remote {

/// A process that works for the server: one world, one evaluator, one run, the database. It ends when this does.
class Child {
 public:
  Child(int socket, int line, int process);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// What may end the waiting for an answer.
  struct Waiting {
    double patience_s = 60;             ///< since the process last said that it is still at it
    std::function<bool()> cancelled{};  ///< nobody wants the answer any more
    bool outlivesCaller = false;        ///< what was begun goes on though nobody wants the answer any more
    std::function<bool()> leaves{};     ///< the process is to leave its work where it can: see isToLeave()
  };
  /// Sends a call and waits for its answer; one at a time, from any thread. Whose `cancelled` comes while he still
  /// waits for his turn goes away. Where the answer does not come in time, or is wanted no more, or the process has
  /// died, the process is ended: alive() is false from then on, and every call is refused with why. Calls that were not
  /// begun by then say so: another process may answer them.
  Answer ask(const std::string& call, const Waiting& waiting);
  bool alive() const;
  /// Ends it at once. From any thread; a call that waits is refused.
  void kill(const std::string& why);

  /// In a child: what it works on is to be left, from now on.
  static bool isToLeave();

  int line() const { return line_; }      ///< a second socket, for what the process asks by itself
  int socket() const { return socket_; }  ///< for whoever waits for both

 private:
  int socket_, line_, process_;  ///< process: a pidfd
  mutable std::mutex state_;
  std::timed_mutex turn_;
  std::string why_;
};

/// Where the server's processes are made: a process with one thread, forked before the server has others, that forks
/// those on demand. (A process with threads cannot be forked safely, and ODE has one world a process.)
class Nursery {
 public:
  /// What a child does; it sees what its maker had in memory when the nursery was made. 3 is its socket, 4 its line.
  /// When this returns, the process ends.
  using Life = std::function<void(char kind)>;
  /// Throws InputError if no process can be made.
  explicit Nursery(Life life);
  ~Nursery();
  Nursery(const Nursery&) = delete;
  Nursery& operator=(const Nursery&) = delete;

  /// From any thread. Throws Refusal.
  std::unique_ptr<Child> start(char kind);

  static constexpr int socketOfChild = 3, lineOfChild = 4;

 private:
  int socket_ = -1;
  int process_ = -1;
  std::mutex mutex_;
};

}  // namespace btr::remote
