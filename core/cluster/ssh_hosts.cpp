#include "core/cluster/ssh_hosts.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "core/cluster/array_job.h"
#include "core/cluster/child.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// "2/lab7": so many elements at a time.
bool hasCount(const std::string& host) {
  const std::size_t slash = host.find('/');
  return slash != std::string::npos && slash > 0 && host.find_first_not_of("0123456789") == slash;
}

/// The words after "2/" with which ssh is called: "ssh -p 2222 lab7", or the host alone.
std::vector<std::string> sshWords(const std::string& host) {
  std::istringstream words(hasCount(host) ? host.substr(host.find('/') + 1) : host);
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  if (all.size() == 1) {
    const char* ssh = std::getenv("PARALLEL_SSH");
    std::istringstream command(ssh ? ssh : "ssh");
    std::vector<std::string> with;
    for (std::string word; command >> word;) with.push_back(word);
    with.push_back(all.front());
    return with;
  }
  return all;
}

/// What a machine says to a command; ssh never asks for a password.
ChildEnd tellHost(const std::string& host, const std::string& command) {
  std::vector<std::string> words = sshWords(host);
  words.insert(words.begin() + 1, {"-o", "BatchMode=yes", "-o", "ConnectTimeout=10"});
  words.push_back(command);
  return runChild(words);
}

/// Why a machine cannot be used; empty if it can.
std::string objectionTo(const std::string& host, const std::string& program) {
  if (sshWords(host).empty()) return "no host";
  const ChildEnd end = tellHost(host, "test -x '" + program + "'");
  if (end.exitCode == 0) return "";
  constexpr int isNotThere = 1;
  return end.exitCode == isNotThere ? program + " is not there" : lastLine(end.err);
}

}  // namespace

std::vector<std::string> requireHosts(const std::string& file) {
  std::istringstream text(readFile(file));
  std::vector<std::string> hosts;
  for (std::string line; std::getline(text, line);) {
    line = line.substr(0, line.find('#'));
    const std::size_t begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    if (begin != std::string::npos) hosts.push_back(line.substr(begin, end - begin + 1));
  }
  if (hosts.empty()) throw InputError(file, "no host", "machines that ssh reaches, one a line");
  return hosts;
}

namespace {

std::string lockFile(const std::string& folder) { return (fs::path(folder) / "ssh.lock").string(); }

/// Held by the process that works on a job over ssh and by the GNU parallel that it starts: it is free only when both
/// are gone. The file names both.
class SshLock {
 public:
  explicit SshLock(const std::string& folder)
      : path_(lockFile(folder)), file_(open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ < 0) throw InputError(path_ + ": cannot be written: " + std::strerror(errno));
    if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    close(file_);
    throw InputError(folder + ": is being worked on over ssh already; btr array cancel " + folder + " stops that");
  }
  ~SshLock() {
    if (ftruncate(file_, 0) != 0) std::fprintf(stderr, "btr: %s: cannot be written\n", path_.c_str());
    close(file_);
  }
  SshLock(const SshLock&) = delete;
  SshLock& operator=(const SshLock&) = delete;
  int file() const { return file_; }
  void name(pid_t parallel) const {
    if (ftruncate(file_, 0) != 0 || dprintf(file_, "%d %d\n", getpid(), parallel) < 0)
      std::fprintf(stderr, "btr: %s: cannot be written: %s\n", path_.c_str(), std::strerror(errno));
  }

 private:
  std::string path_;
  int file_;
};

/// GNU parallel at work on elements of a job.
class OverSsh {
 public:
  OverSsh(std::string folder, std::vector<std::size_t> numbers)
      : folder_(std::move(folder)), numbers_(std::move(numbers)), lock_(folder_) {
    for (const std::size_t number : numbers_)
      if (const ElementState old = loadElementState(folder_, number); !old.state.empty())
        saveElementState(folder_, number, {"", "", "", old.share});
  }

  void work(const std::vector<std::string>& words, const std::atomic<bool>& stop) {
    const std::string log = (fs::path(folder_) / "parallel.log").string();
    writeFile(log, "");
    int out = -1;
    const pid_t parallel = startApart(words, log, out, lock_.file());
    lock_.name(parallel);
    std::string line, other;
    bool asked = false;
    while (true) {
      constexpr int moment_ms = 200;
      pollfd file{out, POLLIN, 0};
      const int ready = poll(&file, 1, moment_ms);
      if (stop && !asked) {
        asked = true;
        askToStop(parallel);
      }
      if (ready <= 0) continue;
      char buffer[4096];
      const ssize_t n = read(out, buffer, sizeof buffer);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      line.append(buffer, static_cast<std::size_t>(n));
      for (std::size_t end = line.find('\n'); end != std::string::npos; end = line.find('\n')) {
        if (!take(line.substr(0, end))) other += line.substr(0, end + 1);
        line.erase(0, end + 1);
      }
    }
    close(out);
    const int code = exitCodeOf(parallel);
    const std::string said = readFile(log);
    if (!other.empty()) writeFile(log, said + other);
    closeStates(asked, lastLine(said));
    constexpr int notFound = 127, isRefused = 255;
    if (code == notFound) throw InputError("GNU parallel is not installed (package parallel)");
    if (code == isRefused && !asked) throw InputError("parallel: " + lastLine(said));
  }

 private:
  /// "3 {…}" is how element 3 is.
  bool take(const std::string& line) {
    std::size_t number = 0, used = 0;
    try {
      number = std::stoul(line, &used);
      if (std::ranges::find(numbers_, number) == numbers_.end()) return false;
      saveElementState(folder_, number, elementStateFromJson(line.substr(used)));
      return true;
    } catch (const std::logic_error&) {
      return false;  // no number
    } catch (const nlohmann::json::exception&) {
      return false;
    }
  }

  /// GNU parallel begins nothing new after a hang-up and waits for what it has begun; that is stopped where it runs.
  void askToStop(pid_t parallel) {
    kill(parallel, SIGHUP);
    for (const std::size_t number : numbers_) {
      const ElementState state = loadElementState(folder_, number);
      if (state.state != "running" || state.login.empty() || state.process <= 0) continue;
      if (const ChildEnd end = tellHost(state.login, "kill -TERM " + std::to_string(state.process)); end.exitCode != 0)
        std::fprintf(stderr, "btr: host %s: element %zu cannot be stopped: %s\n", state.login.c_str(), number,
                     lastLine(end.err).c_str());
    }
  }

  /// What says that it runs when nobody works on it any more, and what could not be begun.
  void closeStates(bool wasStopped, const std::string& lastWords) {
    for (const std::size_t number : numbers_) {
      ElementState state = loadElementState(folder_, number);
      const bool isLost = state.state == "running", wasNeverBegun = state.state.empty() && !wasStopped;
      if (!isLost && !wasNeverBegun) continue;
      state.state = wasStopped ? "stopped" : "failed";
      if (!wasStopped)
        state.note = isLost ? "host " + state.host + ": the connection was lost"
                            : "it could not be begun" + (lastWords.empty() ? "" : ": " + lastWords);
      saveElementState(folder_, number, state);
    }
  }

  std::string folder_;
  std::vector<std::size_t> numbers_;
  SshLock lock_;
};

}  // namespace

void runOverSsh(const std::string& folder, const std::string& hostsFile, const std::vector<std::size_t>& numbers,
                const std::atomic<bool>& stop) {
  const ArrayJob job = loadArrayJob(folder);
  std::string usable;
  for (const std::string& host : requireHosts(hostsFile)) {
    const std::string objection = objectionTo(host, job.program);
    if (objection.empty())
      usable += (hasCount(host) ? "" : "1/") + host + "\n";
    else
      std::fprintf(stderr, "btr: host %s is left out: %s\n", host.c_str(), objection.c_str());
  }
  if (usable.empty())
    throw InputError(hostsFile, "no host that can be used", "machines that ssh reaches and that have " + job.program);
  OverSsh work(folder, numbers);
  const std::string hosts = (fs::path(folder) / "hosts").string();
  writeFile(hosts, usable);

  std::vector<std::string> words{
      "parallel",  "--will-cite", "--line-buffer", "--sshloginfile", hosts,      "--jobs",    "100%",
      "--workdir", "...",         "--cleanup",     "--transferfile", "job.json", "--retries", "3"};
  const bool hasDatabase = fs::exists(elementDatabase(folder, numbers.front()));
  if (!hasDatabase)
    for (const std::size_t number : numbers)
      if (const std::string tar = elementCases(folder, number); !fs::exists(tar)) packCases("", tar);
  const char* const result = hasDatabase ? "{}.db" : "{}.tar";
  words.insert(words.end(), {"--transferfile", result});
  for (const char* back : {result, "{}.json", "{}.log"}) words.insert(words.end(), {"--return", back});
  words.push_back("'" + job.program + "' element . {} --login \"$PARALLEL_SSHLOGIN\"");
  words.emplace_back(":::");
  for (const std::size_t number : numbers) words.push_back(std::to_string(number));
  // Its files are relative to the job's folder.
  words.insert(words.begin(), {"env", "--chdir=" + folder});
  work.work(words, stop);
}

bool isWorkedOnOverSsh(const std::string& folder) {
  const int file = open(lockFile(folder).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool isHeld = flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(file);
  return isHeld;
}

void stopOverSsh(const std::string& folder) {
  pid_t works = 0, parallel = 0;
  if (isWorkedOnOverSsh(folder)) {
    std::istringstream names(readFile(lockFile(folder)));
    names >> works >> parallel;
  }
  if (works > 0 && kill(works, SIGTERM) == 0) return;
  if (parallel > 0 && kill(parallel, SIGTERM) == 0) return;
  throw InputError(folder + ": nobody works on it");
}

}  // namespace btr
