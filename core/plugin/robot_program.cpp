#include "core/plugin/robot_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

extern char** environ;

namespace btr {
namespace {

constexpr double largestAnswer = 1e9;
constexpr std::size_t longestLine = 1u << 20;

std::string howItEnded(int status) {
  if (WIFSIGNALED(status)) return " (signal " + std::to_string(WTERMSIG(status)) + ")";
  return " (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
}

}  // namespace

struct RobotProgram::Impl {
  Options options;
  pid_t pid = -1;
  int toChild = -1, fromChild = -1;
  std::string pending;  // read, but not yet a whole line

  ~Impl() { end(false); }

  /// Closes its input and waits for its end, at most five seconds or, by force, none. Says how it ended.
  std::string end(bool force) {
    if (toChild >= 0) close(toChild);
    if (fromChild >= 0) close(fromChild);
    toChild = fromChild = -1;
    if (pid <= 0) return "";
    const int watched = static_cast<int>(syscall(SYS_pidfd_open, pid, 0));
    pollfd ended{watched, POLLIN, 0};
    if (force || watched < 0 || poll(&ended, 1, 5000) == 0) kill(pid, SIGKILL);
    if (watched >= 0) close(watched);
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    pid = -1;
    return howItEnded(status);
  }

  [[noreturn]] void died() { throw InputError(options.name + " has ended without an answer" + end(false)); }

  /// A whole line; nothing if stopped.
  std::optional<std::string> line() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begun = Clock::now();
    while (true) {
      if (const std::size_t at = pending.find('\n'); at != std::string::npos) {
        std::string found = pending.substr(0, at);
        pending.erase(0, at + 1);
        return found;
      }
      if (pending.size() > longestLine) {
        end(true);
        throw InputError(options.name + ": an answer is longer than " + std::to_string(longestLine) + " bytes");
      }
      if (options.stopped && options.stopped()) return std::nullopt;
      const double waited = std::chrono::duration<double>(Clock::now() - begun).count();
      if (options.timeout_s > 0 && waited > options.timeout_s) {
        end(true);
        throw InputError(options.name + ": no answer within " + toText(options.timeout_s) + " s");
      }
      pollfd readable{fromChild, POLLIN, 0};
      if (poll(&readable, 1, 200) <= 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t n = read(fromChild, buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) died();
      pending.append(buffer.data(), static_cast<std::size_t>(n));
    }
  }
};

RobotProgram::RobotProgram(const std::vector<std::string>& words, Options options) : impl_(new Impl) {
  impl_->options = std::move(options);
  std::array<int, 2> request{}, answer{};
  if (pipe2(request.data(), O_CLOEXEC) != 0 || pipe2(answer.data(), O_CLOEXEC) != 0)
    throw InputError("cannot talk to " + impl_->options.name + ": " + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, request[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, answer[1], STDOUT_FILENO);
  std::vector<std::string> own = words;
  std::vector<char*> arguments;
  for (std::string& word : own) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawn(&impl_->pid, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(request[0]);
  close(answer[1]);
  impl_->toChild = request[1];
  impl_->fromChild = answer[0];
  if (error != 0) {
    impl_->pid = -1;
    throw InputError(words.front() + ": cannot be started as " + impl_->options.name + ": " + std::strerror(error));
  }
}

RobotProgram::~RobotProgram() = default;

std::optional<RealAnswer> RobotProgram::measure(const RealTask& task) {
  const std::string request =
      nlohmann::json{
          {"parameters", task.parameters}, {"repeat", task.repeat}, {"record", task.recordTo}, {"robot", task.pose}}
          .dump() +
      '\n';
  std::size_t sent = 0;
  while (sent < request.size()) {
    const ssize_t n = write(impl_->toChild, request.data() + sent, request.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;  // it has ended; what it said before comes below
    sent += static_cast<std::size_t>(n);
  }
  const std::optional<std::string> line = impl_->line();
  if (!line) return std::nullopt;
  JsonReader answer = JsonReader::parse(*line, "answer of " + impl_->options.name);
  if (answer.has("error")) throw InputError(impl_->options.name + ": " + answer.text("error"));
  const bool isVoid = answer.flag("void", false);
  // Of a trial that failed there is no number.
  const double fitness = isVoid && !answer.has("fitness") ? 0 : answer.number("fitness", -largestAnswer, largestAnswer);
  return RealAnswer{fitness, isVoid, answer.text("note", "")};
}

}  // namespace btr
