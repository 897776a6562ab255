#include "core/cluster/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/spec/error.h"

extern char** environ;  // NOLINT: POSIX

namespace btr {
namespace {

pid_t spawnWith(const std::vector<std::string>& given, posix_spawn_file_actions_t& actions,
                const posix_spawnattr_t* attributes = nullptr) {
  std::vector<std::string> words = given;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = -1;
  const int problem = posix_spawnp(&pid, arguments.front(), &actions, attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) throw InputError(given.front() + ": cannot be started: " + std::strerror(problem));
  return pid;
}

}  // namespace

int exitCodeOf(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  constexpr int killed = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : killed + WTERMSIG(status);
}

ChildEnd runChild(const std::vector<std::string>& words) {
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0)
    throw InputError(words.front() + ": cannot be started: " + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  const pid_t pid = spawnWith(words, actions);
  close(out[1]);
  close(err[1]);
  ChildEnd end;
  pollfd files[2] = {{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
  for (int open = 2; open > 0;) {
    if (poll(files, 2, -1) < 0) continue;
    for (int i = 0; i < 2; ++i) {
      if (files[i].revents == 0) continue;
      char buffer[4096];
      const ssize_t n = read(files[i].fd, buffer, sizeof buffer);
      if (n > 0) {
        (i == 0 ? end.out : end.err).append(buffer, static_cast<std::size_t>(n));
      } else if (n == 0 || errno != EINTR) {
        close(files[i].fd);
        files[i].fd = -1;
        --open;
      }
    }
  }
  end.exitCode = exitCodeOf(pid);
  return end;
}

std::string outputOfChild(const std::vector<std::string>& words) {
  ChildEnd end = runChild(words);
  if (end.exitCode != 0)
    throw InputError(words.front() + ": " +
                     (lastLine(end.err).empty() ? "exit code " + std::to_string(end.exitCode) : lastLine(end.err)));
  return std::move(end.out);
}

pid_t startChild(const std::vector<std::string>& words, const std::string& log) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  return spawnWith(words, actions);
}

pid_t startApart(const std::vector<std::string>& words, const std::string& log, int& out, int kept) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw InputError(words.front() + ": cannot be started: " + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&actions, kept, kept);  // onto itself: it stays open
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t pid = -1;
  try {
    pid = spawnWith(words, actions, &attributes);
  } catch (const InputError&) {
    close(ends[0]);
    close(ends[1]);
    posix_spawnattr_destroy(&attributes);
    throw;
  }
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  out = ends[0];
  return pid;
}

std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return "";
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

}  // namespace btr
