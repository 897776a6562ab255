#include "app/live/btr_camera_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "app/already_said.h"
#include "core/spec/error.h"
#include "core/spec/system/child_process.h"

extern char** environ;  // NOLINT: POSIX

namespace btr::cli {
namespace {

std::string cameraProgram() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "btr-camera").string();
}

/// Both ends of a pipe that no other process inherits.
struct Pipe {
  int ends[2]{-1, -1};
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0) throw InputError("camera", std::strerror(errno), "a pipe to its process");
  }
  ~Pipe() {
    for (const int end : ends)
      if (end >= 0) close(end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int take(int end) { return std::exchange(ends[end], -1); }
};

}  // namespace

CameraProcess::CameraProcess(std::vector<std::string> words, bool answers) : answers_(answers) {
  words.insert(words.begin(), cameraProgram());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  Pipe in, out;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.ends[0], STDIN_FILENO);
  // Without answers: standard output is ours.
  posix_spawn_file_actions_adddup2(&actions, answers ? out.ends[1] : STDERR_FILENO, STDOUT_FILENO);
  const int problem = posix_spawn(&process_, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) {
    process_ = -1;
    throw InputError(words[0], std::strerror(problem), "the camera's program, built with the window, beside btr");
  }
  in_ = in.take(1);
  if (answers) out_ = out.take(0);
}

CameraProcess::~CameraProcess() {
  if (in_ >= 0) close(in_);
  if (out_ >= 0) close(out_);
  if (process_ <= 0) return;
  // Who answers has nothing to finish: one that hangs is ended.
  constexpr int patience_ms = 5000;
  if (answers_ && !endsWithin(process_, patience_ms)) kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool CameraProcess::send(const std::string& line) {
  const std::string text = line + '\n';
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(in_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

bool CameraProcess::read(std::uint8_t* bytes, std::size_t count) {
  // Shorter than anybody waits for the world that asks.
  constexpr int patience_ms = 30000;
  for (std::size_t done = 0; done < count;) {
    pollfd one{out_, POLLIN, 0};
    const int ready = poll(&one, 1, patience_ms);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t got = ::read(out_, bytes + done, count - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    done += static_cast<std::size_t>(got);
  }
  return true;
}

void CameraProcess::finish() {
  if (in_ >= 0) close(std::exchange(in_, -1));
  int status = 0;
  if (process_ <= 0) return;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFSIGNALED(status)) throw InputError(std::string("camera: btr-camera crashed: ") + strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) throw AlreadySaid();
}

}  // namespace btr::cli
