#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/run/stand_in.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

extern char** environ;

namespace btr {

struct StandIn::Impl {
  pid_t pid = -1;
  int toChild = -1, fromChild = -1;
  std::string pending;  // read, but not yet a whole line

  ~Impl() {
    if (toChild >= 0) close(toChild);
    if (fromChild >= 0) close(fromChild);
    int status = 0;
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
  }
};

StandIn::StandIn(const std::string& program, const std::string& database, Id run) : impl_(new Impl) {
  std::array<int, 2> request{}, answer{};
  if (pipe2(request.data(), O_CLOEXEC) != 0 || pipe2(answer.data(), O_CLOEXEC) != 0)
    throw InputError(std::string("cannot talk to the stand-in reality: ") + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, request[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, answer[1], STDOUT_FILENO);
  std::vector<std::string> words{program, "stand-in", "--db", database, "--run", std::to_string(run)};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawn(&impl_->pid, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(request[0]);
  close(answer[1]);
  impl_->toChild = request[1];
  impl_->fromChild = answer[0];
  if (error != 0) {
    impl_->pid = -1;
    throw InputError(program + ": cannot be started as stand-in reality: " + std::strerror(error));
  }
}

StandIn::~StandIn() = default;

RealAnswer StandIn::measure(const std::vector<double>& parameters, int repeat, const RecordTo& record) {
  const std::string request =
      nlohmann::json{
          {"parameters", parameters}, {"repeat", repeat}, {"record", record.file}, {"robot", toText(record.pose)}}
          .dump() +
      '\n';
  std::size_t sent = 0;
  while (sent < request.size()) {
    const ssize_t n = write(impl_->toChild, request.data() + sent, request.size() - sent);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;  // it has ended; what it said before comes below
    sent += static_cast<std::size_t>(n);
  }
  std::size_t end;
  while ((end = impl_->pending.find('\n')) == std::string::npos) {
    std::array<char, 4096> buffer;
    const ssize_t n = read(impl_->fromChild, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw InputError("the stand-in reality has ended without an answer");
    impl_->pending.append(buffer.data(), static_cast<std::size_t>(n));
  }
  JsonReader answer = JsonReader::parse(impl_->pending.substr(0, end), "answer of the stand-in reality");
  impl_->pending.erase(0, end + 1);
  if (answer.has("error")) throw InputError("the stand-in reality: " + answer.text("error"));
  return {answer.number("fitness", -largestFitness, largestFitness), answer.flag("void", false),
          answer.text("note", "")};
}

std::string StandIn::programFor(const ExperimentSpec& spec) {
  const char* btr = std::getenv("UCHILSIM_BTR");
  const char* named = std::getenv("UCHILSIM_STAND_IN");
  if (valueOf(standInParameters(), spec.standIn, "played_by") == 1) {
    if (named && *named) return named;
    throw InputError("experiment /stand_in/played_by", "program",
                     "the environment variable UCHILSIM_STAND_IN to name the program that plays the robot");
  }
  if (btr && *btr) return btr;
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "btr").string();
}

}  // namespace btr
