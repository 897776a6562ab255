#include "core/cluster/ssh_hosts.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "core/cluster/array_job.h"
#include "core/cluster/child.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// The words after "2/" with which ssh is called: "ssh -p 2222 lab7", or the host alone.
std::vector<std::string> sshWords(const std::string& host) {
  const std::size_t slash = host.find('/');
  const bool hasCount = slash != std::string::npos && host.find_first_not_of("0123456789") == slash;
  std::istringstream words(hasCount ? host.substr(slash + 1) : host);
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

/// Why a machine cannot be used; empty if it can.
std::string objectionTo(const std::string& host, const std::string& program) {
  std::vector<std::string> words = sshWords(host);
  if (words.empty()) return "no host";
  words.insert(words.begin() + 1, {"-o", "BatchMode=yes", "-o", "ConnectTimeout=10"});
  words.push_back("test -x '" + program + "'");
  const ChildEnd end = runChild(words);
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

void runOverSsh(const std::string& folder, const std::string& hostsFile, const std::vector<std::size_t>& numbers) {
  const ArrayJob job = loadArrayJob(folder);
  std::string usable;
  for (const std::string& host : requireHosts(hostsFile)) {
    const std::string objection = objectionTo(host, job.program);
    if (objection.empty())
      usable += host + "\n";
    else
      std::fprintf(stderr, "btr: host %s is left out: %s\n", host.c_str(), objection.c_str());
  }
  if (usable.empty())
    throw InputError(hostsFile, "no host that can be used", "machines that ssh reaches and that have " + job.program);
  const std::string hosts = (fs::path(folder) / "hosts").string();
  writeFile(hosts, usable);

  std::vector<std::string> words{"parallel", "--will-cite", "--sshloginfile", hosts,      "--jobs",    "1", "--workdir",
                                 "...",      "--cleanup",   "--transferfile", "job.json", "--retries", "3"};
  const bool hasDatabase = fs::exists(elementDatabase(folder, numbers.front()));
  if (hasDatabase) words.insert(words.end(), {"--transferfile", "{}.db"});
  for (const char* result : {hasDatabase ? "{}.db" : "{}.tar", "{}.json", "{}.log"})
    words.insert(words.end(), {"--return", result});
  words.push_back("'" + job.program + "' element . {}");
  words.emplace_back(":::");
  for (const std::size_t number : numbers) words.push_back(std::to_string(number));
  // Its files are relative to the job's folder.
  words.insert(words.begin(), {"env", "--chdir=" + folder});
  const ChildEnd end = runChild(words);
  writeFile((fs::path(folder) / "parallel.log").string(), end.out + end.err);
  constexpr int notFound = 127, isRefused = 255;
  if (end.exitCode == notFound) throw InputError("GNU parallel is not installed (package parallel)");
  if (end.exitCode == isRefused) throw InputError("parallel: " + lastLine(end.err));
}

}  // namespace btr
