#include "core/openr/robot_process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <vector>

#include "core/openr/link_stream.h"
#include "core/openr/robot_design.h"
#include "core/openr/stick_config.h"
#include "core/spec/error.h"

extern char** environ;

namespace btr::openr {
namespace {

constexpr int childLink = 3;

std::string besideThisProgram(const std::string& name) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? name : (self.parent_path() / name).string();
}

}  // namespace

RobotProcess::RobotProcess(const Options& options) {
  robotDesign(options.design);
  stickConfig(options.stick, options.design);
  const std::string program = options.program.empty() ? besideThisProgram("openr_robot") : options.program;
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw InputError(std::string("the robot's program cannot be reached: ") + std::strerror(errno));
  const std::vector<std::string> words = {program,
                                          "--stick",
                                          options.stick,
                                          "--design",
                                          options.design,
                                          "--link",
                                          std::to_string(childLink),
                                          "--method-limit",
                                          std::to_string(options.methodLimit_s)};
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], childLink);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  const int error = posix_spawn(&process_, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    process_ = -1;
    throw InputError(program + " cannot be started: " + std::strerror(error));
  }
  link_ = ends[0];
}

RobotProcess::~RobotProcess() { kill(); }

void RobotProcess::kill() {
  if (link_ >= 0) close(link_);
  link_ = -1;
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

OrderFrame RobotProcess::endWith(Ended::Why why, const std::string& what) {
  OrderFrame orders;
  orders.ended = ended_ = Ended{why, "", "", what};
  kill();
  return orders;
}

// It has hung up. A program that closes its link and lives on is ended, too.
std::string RobotProcess::howItEnded() {
  if (process_ <= 0) return "its process is gone";
  constexpr int patience_ms = 1000;
  const int watched = static_cast<int>(syscall(SYS_pidfd_open, process_, 0));
  pollfd one{watched, POLLIN, 0};
  const bool over = watched >= 0 && poll(&one, 1, patience_ms) > 0;
  if (watched >= 0) close(watched);
  if (!over) ::kill(process_, SIGKILL);
  int status = 0;
  pid_t waited;
  while ((waited = waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
  }
  const bool known = waited == process_;
  process_ = -1;
  if (!known) return "its process is gone";
  if (!over) return "its process has closed the link to its robot, and was ended";
  if (WIFSIGNALED(status)) return std::string("its process was ended by a signal: ") + strsignal(WTERMSIG(status));
  return "its process ended by itself with status " + std::to_string(WEXITSTATUS(status));
}

OrderFrame RobotProcess::exchange(const SensorFrame& frame, double deadline_s) {
  if (ended_) {
    OrderFrame orders;
    orders.ended = ended_;
    return orders;
  }
  std::vector<std::uint8_t> bytes;
  const Deadline until = std::chrono::steady_clock::now() +
                         std::chrono::duration_cast<Deadline::duration>(std::chrono::duration<double>(deadline_s));
  // Who did not take the frame may have said why before it went.
  Passed passed = sendMessage(link_, bytesOf(frame), until);
  if (passed != Passed::late) passed = receiveMessage(link_, bytes, until);
  if (passed == Passed::late) return endWith(Ended::Why::endlessLoop, "its process has not answered in time");
  if (passed == Passed::gone) return endWith(Ended::Why::crash, howItEnded());
  try {
    OrderFrame orders = orderFrameFrom(bytes.data(), bytes.size());
    if (orders.ended) {
      ended_ = orders.ended;
      kill();
    }
    return orders;
  } catch (const InputError& error) {
    return endWith(Ended::Why::crash, std::string("it sent what is no order: ") + error.what());
  }
}

}  // namespace btr::openr
