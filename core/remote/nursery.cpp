#include "core/remote/nursery.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>

#include "core/remote/frame.h"
#include "core/spec/error.h"
#include "core/spec/system/crash_report.h"

namespace btr::remote {
namespace {

// What passes between server and nursery is one byte with descriptors: the kind with a child's two sockets on the way
// there, a pidfd on the way back.
bool sendWith(int socket, char byte, const int* descriptors, std::size_t count) {
  iovec data{&byte, 1};
  alignas(cmsghdr) char room[CMSG_SPACE(2 * sizeof(int))] = {};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  if (count > 0) {
    message.msg_control = room;
    message.msg_controllen = CMSG_SPACE(count * sizeof(int));
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(count * sizeof(int));
    std::memcpy(CMSG_DATA(header), descriptors, count * sizeof(int));
  }
  ssize_t sent;
  while ((sent = sendmsg(socket, &message, MSG_NOSIGNAL)) < 0 && errno == EINTR) {
  }
  return sent == 1;
}

bool receiveWith(int socket, char& byte, std::array<int, 2>& descriptors) {
  descriptors = {-1, -1};
  iovec data{&byte, 1};
  alignas(cmsghdr) char room[CMSG_SPACE(2 * sizeof(int))] = {};
  msghdr message{};
  message.msg_iov = &data;
  message.msg_iovlen = 1;
  message.msg_control = room;
  message.msg_controllen = sizeof room;
  ssize_t got;
  while ((got = recvmsg(socket, &message, MSG_CMSG_CLOEXEC)) < 0 && errno == EINTR) {
  }
  if (got != 1) return false;
  if (const cmsghdr* header = CMSG_FIRSTHDR(&message); header && header->cmsg_type == SCM_RIGHTS)
    std::memcpy(descriptors.data(), CMSG_DATA(header),
                std::min<std::size_t>(header->cmsg_len - CMSG_LEN(0), sizeof(int) * descriptors.size()));
  return true;
}

// Only what a signal handler may do. The answer's code comes first, see Child::ask().
void tellServerOfCrash(const char* text, std::size_t size) {
  char frame[4 + 1 + 400];
  size = std::min<std::size_t>(size, 400);
  const auto all = static_cast<std::uint32_t>(size + 1);
  std::memcpy(frame, &all, 4);
  frame[4] = static_cast<char>(Code::internal);
  std::memcpy(frame + 5, text, size);
  [[maybe_unused]] const ssize_t sent = send(Nursery::socketOfChild, frame, 5 + size, MSG_NOSIGNAL);
}

// Told to leave its work.
volatile sig_atomic_t leaving = 0;
void onLeave(int) { leaving = 1; }

[[noreturn]] void live(const Nursery::Life& life, char kind, const std::array<int, 2>& sockets) {
  signal(SIGCHLD, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  // Neither lies on 3 or 4: those are the nursery's socket, or closed.
  const int socket = fcntl(sockets[0], F_DUPFD, 10), line = fcntl(sockets[1], F_DUPFD, 10);
  dup2(socket, Nursery::socketOfChild);
  dup2(line, Nursery::lineOfChild);
  close_range(Nursery::lineOfChild + 1, ~0U, 0);
  struct sigaction leave {};
  leave.sa_handler = onLeave;
  leave.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &leave, nullptr);
  tellCrashes(tellServerOfCrash, false);
  try {
    life(kind);
  } catch (const std::exception& error) {
    constexpr double patience_s = 10;
    sendFrame(Nursery::socketOfChild, static_cast<char>(Code::internal) + std::string(error.what()), patience_s);
  }
  _exit(0);
}

/// The nursery's own life: until the server hangs up.
[[noreturn]] void serve(int socket, const Nursery::Life& life) {
  // Ctrl-C reaches the whole group: the server decides. Children that ended leave nothing behind.
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  signal(SIGCHLD, SIG_IGN);
  dup2(socket, 3);
  close_range(4, ~0U, 0);
  char kind;
  std::array<int, 2> sockets;
  while (receiveWith(3, kind, sockets)) {
    const pid_t nursery = getpid();
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != nursery) _exit(0);
      live(life, kind, sockets);
    }
    const int process = pid < 0 ? -1 : static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    sendWith(3, process < 0 ? 'F' : 'C', &process, process < 0 ? 0 : 1);
    if (process >= 0) close(process);
    close(sockets[0]);
    close(sockets[1]);
  }
  _exit(0);
}

}  // namespace

Child::Child(int socket, int line, int process) : socket_(socket), line_(line), process_(process) {}

Child::~Child() {
  kill("it was closed");
  close(socket_);
  close(line_);
  close(process_);
}

bool Child::isToLeave() { return leaving != 0; }

bool Child::alive() const {
  const std::lock_guard lock(state_);
  return why_.empty();
}

void Child::kill(const std::string& why) {
  const std::lock_guard lock(state_);
  if (!why_.empty()) return;
  why_ = why;
  syscall(SYS_pidfd_send_signal, process_, SIGKILL, nullptr, 0);
  shutdown(socket_, SHUT_RDWR);
  shutdown(line_, SHUT_RDWR);
}

Answer Child::ask(const std::string& call, const Waiting& waiting) {
  std::unique_lock turn(turn_, std::defer_lock);
  const auto& cancelled = waiting.cancelled;
  constexpr auto look = std::chrono::milliseconds(100);
  while (!turn.try_lock_for(look))
    if (cancelled && cancelled()) return {Code::cancelled, "the call was cancelled before its turn came", false};
  const auto ended = [&](Code code, const std::string& why) {
    kill(why);
    const std::lock_guard lock(state_);
    return Answer{code, why_};
  };
  if (!alive()) {
    Answer answer = ended(Code::unavailable, "");
    answer.begun = false;
    return answer;
  }
  const auto unwanted = [&] { return cancelled && !waiting.outlivesCaller && cancelled(); };
  // Who is told to leave gets a moment for it.
  constexpr auto moment = std::chrono::seconds(5);
  std::optional<std::chrono::steady_clock::time_point> leavesBy;
  bool stays = false;
  const auto lookOn = [&] {
    if (waiting.leaves && waiting.leaves()) {
      syscall(SYS_pidfd_send_signal, process_, SIGUSR1, nullptr, 0);
      const auto now = std::chrono::steady_clock::now();
      if (!leavesBy) leavesBy = now + moment;
      stays = now > *leavesBy;
    }
    return stays || unwanted();
  };
  const auto late = [&] {
    if (stays) return ended(Code::cancelled, "the server ends, and it did not leave its work");
    return unwanted()
               ? ended(Code::cancelled, "the call was cancelled while it worked")
               : ended(Code::tooLate, "it has not answered for " +
                                          std::to_string(static_cast<long>(waiting.patience_s)) + " s and was ended");
  };
  std::string bytes;
  switch (sendFrame(socket_, call, waiting.patience_s, unwanted)) {
    case Sent::nothing:
      return late();
    case Sent::hungUp:
      return ended(Code::unavailable, "its process has ended; the server's standard error says why");
    case Sent::whole:
      break;
  }
  do {
    switch (receiveFrame(socket_, bytes, waiting.patience_s, lookOn, waiting.patience_s)) {
      case Got::nothing:
        return late();
      case Got::hungUp:
        return ended(Code::unavailable, "its process has ended; the server's standard error says why");
      case Got::frame:
        break;
    }
    if (bytes.empty() && lookOn()) return late();
  } while (bytes.empty());  // it is still at it
  return {static_cast<Code>(bytes[0]), bytes.substr(1)};
}

Nursery::Nursery(Life life) {
  int pair[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
    throw InputError(std::string("cannot make a process: ") + std::strerror(errno));
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0) {
    close(pair[0]);
    close(pair[1]);
    throw InputError(std::string("cannot make a process: ") + std::strerror(errno));
  }
  if (process_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(0);
    serve(pair[1], life);
  }
  close(pair[1]);
  socket_ = pair[0];
}

Nursery::~Nursery() {
  close(socket_);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::unique_ptr<Child> Nursery::start(char kind) {
  const std::lock_guard lock(mutex_);
  int work[2], line[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, work) != 0)
    throw Refusal(Code::tooMuch, std::string("cannot make a process: ") + std::strerror(errno));
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line) != 0) {
    const int error = errno;
    close(work[0]);
    close(work[1]);
    throw Refusal(Code::tooMuch, std::string("cannot make a process: ") + std::strerror(error));
  }
  const int given[2] = {work[1], line[1]};
  char reply = 'F';
  std::array<int, 2> process{-1, -1};
  const bool isThere = sendWith(socket_, kind, given, 2) && receiveWith(socket_, reply, process);
  const bool made = isThere && process[0] >= 0;
  close(work[1]);
  close(line[1]);
  if (made) return std::make_unique<Child>(work[0], line[0], process[0]);
  close(work[0]);
  close(line[0]);
  if (!isThere)
    throw Refusal(Code::unavailable, "the process that makes the server's others has ended; start the server again");
  throw Refusal(Code::tooMuch, "cannot make a process: the system gives no more");
}

}  // namespace btr::remote
