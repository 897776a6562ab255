#include "core/cluster/crew.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"

extern char** environ;  // NOLINT: POSIX

namespace btr {
namespace {

/// So often a foreman may end without a result before it is given up.
constexpr int mostLosses = 5;

struct Foreman {
  pid_t pid = -1;
  int socket = -1;
  int losses = 0;  ///< since it last had a result
  bool gone = false;
  std::string arriving, leaving;
};

std::string howItEnded(int status) {
  if (WIFSIGNALED(status)) return "its process was killed (signal " + std::to_string(WTERMSIG(status)) + ")";
  return "its process ended (exit code " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1) + ")";
}

/// The environment without what a launcher says to its own ranks: a foreman is none.
std::vector<char*> environmentOfAForeman() {
  std::vector<char*> all;
  for (char** entry = environ; *entry; ++entry) {
    bool isLaunchers = false;
    for (const char* beginning : {"OMPI_COMM_WORLD_", "PMIX_", "PMI_", "SLURM_STEP_NUM_TASKS="})
      isLaunchers = isLaunchers || std::strncmp(*entry, beginning, std::strlen(beginning)) == 0;
    if (!isLaunchers) all.push_back(*entry);
  }
  all.push_back(nullptr);
  return all;
}

void startForeman(Foreman& foreman, const ForemanCommand& command) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw InputError(std::string("cannot make a worker process: ") + std::strerror(errno));
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<char*> environment = environmentOfAForeman();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  const int problem =
      posix_spawnp(&foreman.pid, words.front().c_str(), &actions, nullptr, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (problem != 0) {
    close(ends[0]);
    foreman.pid = -1;
    throw InputError(words.front(), std::strerror(problem), "a program that works on pieces");
  }
  fcntl(ends[0], F_SETFL, fcntl(ends[0], F_GETFL) | O_NONBLOCK);
  foreman.socket = ends[0];
  foreman.arriving.clear();
  foreman.leaving.clear();
}

int endAtOnce(Foreman& foreman) {
  int status = 0;
  if (foreman.pid <= 0) return status;
  kill(foreman.pid, SIGKILL);
  close(foreman.socket);
  while (waitpid(foreman.pid, &status, 0) < 0 && errno == EINTR) {
  }
  foreman.pid = foreman.socket = -1;
  return status;
}

/// How a process ends that has closed its end, given a moment to do so.
int endOf(Foreman& foreman) {
  int status = 0;
  for (int i = 0; i < 200; ++i) {
    const pid_t ended = waitpid(foreman.pid, &status, WNOHANG);
    if (ended == foreman.pid || (ended < 0 && errno != EINTR)) {
      close(foreman.socket);
      foreman.pid = foreman.socket = -1;
      return status;
    }
    usleep(1000);
  }
  return endAtOnce(foreman);
}

void writeWhatLeaves(Foreman& foreman) {
  while (!foreman.leaving.empty()) {
    const ssize_t n = ::send(foreman.socket, foreman.leaving.data(), foreman.leaving.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;  // full, or the reading end will tell that it is gone
    foreman.leaving.erase(0, static_cast<std::size_t>(n));
  }
}

/// Reads what is there. False at its end.
bool readWhatIsThere(Foreman& foreman) {
  char buffer[1 << 16];
  while (true) {
    const ssize_t n = ::read(foreman.socket, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
    if (n == 0) return false;
    foreman.arriving.append(buffer, static_cast<std::size_t>(n));
  }
}

/// The next whole message of what has arrived.
bool takeMessage(Foreman& foreman, Parts& parts) {
  std::uint64_t size = 0;
  if (foreman.arriving.size() < sizeof size) return false;
  std::memcpy(&size, foreman.arriving.data(), sizeof size);
  if (foreman.arriving.size() - sizeof size < size) return false;
  parts = unpack(foreman.arriving.substr(sizeof size, size));
  foreman.arriving.erase(0, sizeof size + size);
  return true;
}

}  // namespace

ForemanCommand ownForeman() { return {std::filesystem::read_symlink("/proc/self/exe").string(), "pieces"}; }

struct Crew::Impl {
  ForemanCommand command;
  std::vector<Foreman> foremen;
  std::vector<Event> waiting;  ///< events that are told with the next wait()

  void lost(std::size_t k, const std::string& why) {
    Foreman& foreman = foremen[k];
    const int number = static_cast<int>(k);
    if (++foreman.losses >= mostLosses) {
      foreman.gone = true;
      waiting.push_back({number, {"gone", why}});
      return;
    }
    waiting.push_back({number, {"lost", why}});
    try {
      startForeman(foreman, command);
    } catch (const InputError& error) {
      foreman.gone = true;
      waiting.push_back({number, {"gone", error.what()}});
    }
  }
};

Crew::Crew(int foremen, ForemanCommand command) : impl_(new Impl{std::move(command), {}, {}}) {
  impl_->foremen.resize(static_cast<std::size_t>(foremen));
  for (Foreman& foreman : impl_->foremen) startForeman(foreman, impl_->command);
}

Crew::~Crew() {
  for (Foreman& foreman : impl_->foremen) endAtOnce(foreman);
}

int Crew::size() const { return static_cast<int>(impl_->foremen.size()); }

void Crew::send(int number, const Parts& parts) {
  Foreman& foreman = impl_->foremen[static_cast<std::size_t>(number)];
  if (foreman.pid <= 0) return;
  const std::string bytes = pack(parts);
  const std::uint64_t size = bytes.size();
  foreman.leaving.append(reinterpret_cast<const char*>(&size), sizeof size);
  foreman.leaving += bytes;
  writeWhatLeaves(foreman);
}

void Crew::restart(int number) {
  const auto k = static_cast<std::size_t>(number);
  if (impl_->foremen[k].pid <= 0) return;
  endAtOnce(impl_->foremen[k]);
  impl_->lost(k, "it did not answer in time");
}

std::vector<Crew::Event> Crew::wait(std::chrono::microseconds most) {
  std::vector<pollfd> files;
  std::vector<std::size_t> whose;
  for (std::size_t k = 0; k < impl_->foremen.size(); ++k) {
    const Foreman& foreman = impl_->foremen[k];
    if (foreman.pid <= 0) continue;
    files.push_back({foreman.socket, static_cast<short>(POLLIN | (foreman.leaving.empty() ? 0 : POLLOUT)), 0});
    whose.push_back(k);
  }
  const auto wait_us = impl_->waiting.empty() ? most.count() : 0;
  constexpr long perSecond = 1000000, perMicro = 1000;
  const timespec limit{static_cast<time_t>(wait_us / perSecond), static_cast<long>(wait_us % perSecond) * perMicro};
  ppoll(files.data(), files.size(), &limit, nullptr);
  std::vector<Event> events = std::move(impl_->waiting);
  impl_->waiting.clear();
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].revents == 0) continue;
    Foreman& foreman = impl_->foremen[whose[i]];
    if (files[i].revents & POLLOUT) writeWhatLeaves(foreman);
    if (!(files[i].revents & ~POLLOUT)) continue;
    const bool goesOn = readWhatIsThere(foreman);
    for (Parts parts; takeMessage(foreman, parts);) {
      if (!parts.empty() && parts.front() == "done") foreman.losses = 0;
      events.push_back({static_cast<int>(whose[i]), std::move(parts)});
    }
    if (goesOn) continue;
    impl_->lost(whose[i], howItEnded(endOf(foreman)));
  }
  for (Event& event : impl_->waiting) events.push_back(std::move(event));
  impl_->waiting.clear();
  return events;
}

}  // namespace btr
