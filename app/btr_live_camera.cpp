#include "app/btr_live_camera.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/btr_live_lines.h"
#include "core/spec/error.h"

extern char** environ;  // NOLINT: POSIX

namespace btr::cli {
namespace {

std::string cameraProgram() {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "btr-camera").string();
}

}  // namespace

void addCameraOptions(CLI::App& live, LiveCameraOptions& options, Shell& shell) {
  CLI::Option* robot = live.add_option("--camera", options.robot, "the robot whose camera looks");
  live.add_option("--camera-file", options.camera, "its camera (*.json); else that of the robot's model")
      ->check(CLI::ExistingFile)
      ->needs(robot);
  const auto writes = [&](CLI::Option* option) { option->needs(robot); };
  writes(shell.writesFolder(&live, live.add_option("--frames", options.frames, "writes each frame into this folder")));
  writes(shell.writesFile(&live, live.add_option("--video", options.video, "writes a video (*.mp4, *.avi, *.mkv)")));
  writes(shell.writesFile(&live, live.add_option("--truth", options.truth, "writes what was really there (*.csv)")));
}

LiveCamera::LiveCamera(const LiveCameraOptions& options, const Session& session) {
  std::vector<std::string> words{cameraProgram(), "watch", "--robot", options.robot};
  const auto add = [&](const char* option, const std::string& value) {
    if (value.empty()) return;
    words.emplace_back(option);
    words.push_back(value);
  };
  add("--camera", options.camera);
  add("--frames", options.frames);
  add("--video", options.video);
  add("--truth", options.truth);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw InputError("camera", std::strerror(errno), "a pipe to its process");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);  // standard output is ours
  const int problem = posix_spawn(&process_, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (problem != 0) {
    process_ = -1;
    throw InputError(words[0], std::strerror(problem), "the camera's program, built with the window, beside btr");
  }
  tell(session);
}

LiveCamera::~LiveCamera() {
  if (pipe_ >= 0) close(pipe_);
  if (process_ > 0) waitpid(process_, nullptr, 0);
}

void LiveCamera::tell(const Session& session) {
  if (std::vector<std::string> channels = session.channels(); channels != channels_) {
    channels_ = std::move(channels);
    send(gameLine(session).dump());
  }
  send(rowLine(session).dump());
}

void LiveCamera::send(const std::string& line) {
  const std::string text = line + '\n';
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(pipe_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) finish();  // says why
    done += static_cast<std::size_t>(written);
  }
}

void LiveCamera::finish() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  int status = 0;
  if (process_ <= 0) return;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw InputError("camera",
                   WIFSIGNALED(status) ? std::string("btr-camera crashed: ") + strsignal(WTERMSIG(status))
                                       : "btr-camera ended with the error above",
                   "frames up to the end of the session");
}

}  // namespace btr::cli
