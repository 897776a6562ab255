#include "core/gap/proof/proof_case.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/gap/proof/proof_fresh.h"
#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/report/report_files.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

extern char** environ;  // NOLINT: POSIX

namespace btr {
namespace {

namespace fs = std::filesystem;

/// What a program writes, from both of its ends until they are closed.
std::array<std::string, 2> readBoth(std::array<int, 2> files) {
  std::array<std::string, 2> texts;
  std::array<pollfd, 2> polled{pollfd{files[0], POLLIN, 0}, pollfd{files[1], POLLIN, 0}};
  for (int open = 2; open > 0;) {
    if (poll(polled.data(), polled.size(), -1) < 0) continue;
    for (std::size_t i = 0; i < polled.size(); ++i) {
      if (polled[i].revents == 0) continue;
      std::array<char, 4096> buffer;
      const ssize_t n = read(polled[i].fd, buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n > 0) {
        texts[i].append(buffer.data(), static_cast<std::size_t>(n));
        continue;
      }
      polled[i].fd = -1;
      --open;
    }
  }
  return texts;
}

/// The last line, for a sentence.
std::string lastLineOf(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);  // npos + 1 is 0
}

/// The generator was killed from outside, as by a machine without memory: no property of the case.
class GeneratorKilled : public InputError {
 public:
  using InputError::InputError;
};

/// Standard output of a program that must succeed.
std::string outputOf(std::vector<std::string> words) {
  std::array<int, 2> out{}, err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0) throw InputError(words[0] + ": " + std::strerror(errno));
  if (pipe2(err.data(), O_CLOEXEC) != 0) {
    const int why = errno;
    for (const int file : out) close(file);
    throw InputError(words[0] + ": " + std::strerror(why));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);
  close(err[1]);
  std::array<std::string, 2> said;
  if (error == 0) said = readBoth({out[0], err[0]});
  close(out[0]);
  close(err[0]);
  if (error != 0) throw InputError(words[0] + ": cannot be started: " + std::strerror(error));
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return said[0];
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    throw GeneratorKilled(words[0] + " " + words[1] + ": was killed (signal 9)");
  const std::string why = lastLineOf(said[1]);
  throw InputError(words[0] + " " + words[1] + ": " + (why.empty() ? "has failed" : why));
}

std::vector<std::string> concealWords(const ProofRequest& request, const std::string& command, std::size_t number) {
  std::vector<std::string> words{request.generator,     command, "--seed", std::to_string(request.seed), "--case",
                                 std::to_string(number)};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--engine", request.engine);
  add("--scene", request.scene);
  add("--kind", request.kind);
  add("--dirt", request.dirt);
  if (request.spoiled > 0) add("--spoiled", std::to_string(request.spoiled));
  return words;
}

fs::path folderOf(const ProofRequest& request, std::size_t number) {
  return fs::path(request.out) / nameOfCase(number);
}

/// The scene as the report names it.
std::string placeOfScene(const ProofRequest& request, std::size_t number) {
  const fs::path folder = request.place.empty() ? request.out : request.place;
  return fs::absolute(folder / nameOfCase(number) / "scene.json").lexically_normal().string();
}

/// A text that names the folder where a case stands for now, as if it stood in its place.
std::string inItsPlace(std::string text, const ProofRequest& request) {
  if (request.place.empty() || request.out.empty()) return text;
  for (std::size_t at = text.find(request.out); at != std::string::npos;
       at = text.find(request.out, at + request.place.size()))
    text.replace(at, request.out.size(), request.place);
  return text;
}

std::vector<std::string> recordingsIn(const fs::path& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// The error of what was found in recordings that did not exist when it was found; none where it cannot be replayed.
Values errorsAfterwards(const ProofRequest& request, std::size_t number, const GapReport& report,
                        const EffectLibrary& library) {
  const fs::path folder = folderOf(request, number), fresh = folder / "fresh";
  auto words = concealWords(request, "fresh", number);
  words.insert(words.end(), {"--out", fresh.string()});
  outputOf(words);
  try {
    return freshErrors(report, (folder / "scene.json").string(), recordingsIn(fresh), library);
  } catch (const InputError&) {
    return {};
  }
}

void proveOnce(const ProofRequest& request, std::size_t number, const EffectLibrary& library, const Analyse& analyse) {
  const fs::path folder = folderOf(request, number);
  fs::remove_all(folder);  // what an interrupted run left
  auto make = concealWords(request, "make", number);
  make.insert(make.end(), {"--out", folder.string()});
  std::string seal = outputOf(make);
  while (!seal.empty() && seal.back() == '\n') seal.pop_back();
  writeFile((folder / "seal.txt").string(), seal + "\n");

  AnalysisRequest asked;
  asked.scene = (folder / "scene.json").string();
  asked.recordings = recordingsIn(folder);
  asked.options = request.options;
  asked.options.jobs = 1;
  GapReport report;
  std::string failure;
  try {
    report = analyse(asked, library);
  } catch (const std::exception& error) {
    failure = inItsPlace(error.what(), request);
  }
  // Outside of that: a disk that is full is no fault of the analysis.
  if (failure.empty()) {
    report.scene = placeOfScene(request, number);
    writeReport(report, (folder / "analysis").string());
  }

  // Only now.
  const std::string answer = outputOf(concealWords(request, "open", number));
  if (sha256(answer) != seal)
    throw InputError((folder / "seal.txt").string(), "the answer that was opened", "only the one that was sealed");
  writeFile((folder / "answer.json").string(), answer);
  const Values fresh = failure.empty() ? errorsAfterwards(request, number, report, library) : Values{};
  ProvedCase proved = judged(answerFromJson(answer, (folder / "answer.json").string()), report, fresh);
  if (!failure.empty()) proved.verdict.clear();
  proved.failure = failure;
  writeFile((folder / "verdict.json").string(), toJsonText(proved));
}

}  // namespace

std::string nameOfCase(std::size_t number) {
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 3 ? 3 - digits.size() : 0, '0');
  return "case_" + digits;
}

std::string verdictOfCase(const std::string& out, std::size_t number) {
  return (fs::path(out) / nameOfCase(number) / "verdict.json").string();
}

void proveCase(const ProofRequest& request, std::size_t number, const EffectLibrary& library, const Analyse& analyse) {
  // A second time, as a worker that died would be.
  try {
    proveOnce(request, number, library, analyse);
  } catch (const GeneratorKilled&) {
    proveOnce(request, number, library, analyse);
  }
}

}  // namespace btr
