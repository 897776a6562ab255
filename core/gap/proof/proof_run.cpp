#include "core/gap/proof/proof_run.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/proof/proof_fresh.h"
#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proof_tally.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

extern char** environ;

namespace btr {
namespace {

namespace fs = std::filesystem;

/// Standard output of a program that must succeed.
std::string outputOf(std::vector<std::string> words) {
  std::array<int, 2> answer{};
  if (pipe2(answer.data(), O_CLOEXEC) != 0) throw InputError(words[0] + ": " + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, answer[1], STDOUT_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(answer[1]);
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t n = 1; error == 0 && n != 0;) {
    n = read(answer[0], buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  close(answer[0]);
  if (error != 0) throw InputError(words[0] + ": cannot be started: " + std::strerror(error));
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw InputError(words[0] + " " + words[1] + ": has failed");
  return text;
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
  std::string digits = std::to_string(number);
  digits.insert(0, digits.size() < 3 ? 3 - digits.size() : 0, '0');
  return fs::path(request.out) / ("case_" + digits);
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

/// One case from concealing to the opened seal.
void proveCase(const ProofRequest& request, std::size_t number, const EffectLibrary& library, const Analyse& analyse) {
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
  asked.out = (folder / "analysis").string();
  asked.options = request.options;
  asked.options.jobs = 1;
  GapReport report;
  std::string failure;
  try {
    report = analyse(asked, library);
  } catch (const std::exception& error) {
    failure = error.what();
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

/// A folder belongs to one trial; more cases may be added to it.
void claimFolder(const ProofRequest& request) {
  std::error_code failure;
  fs::create_directories(request.out, failure);
  if (!fs::is_directory(request.out)) throw InputError(request.out + ": the folder cannot be made");
  const nlohmann::json trial{{"format", "uchilsim-proof-trial-3"},
                             {"seed", request.seed},
                             {"engine", request.engine},
                             {"scene", request.scene},
                             {"kind", request.kind},
                             {"dirt", request.dirt},
                             {"spoiled", request.spoiled},
                             {"analysis_seed", request.options.seed}};
  const std::string text = trial.dump(2) + "\n", path = (fs::path(request.out) / "trial.json").string();
  if (fs::exists(path) && readFile(path) != text)
    throw InputError(path, "another generator, seed, engine, scene, kind or dirt",
                     "the same as in the trial that the folder holds");
  writeFile(path, text);
}

}  // namespace

std::string findGenerator() {
  std::string path;
  if (const char* given = std::getenv("UCHILSIM_CONCEAL")) path = given;
  if (path.empty()) path = (fs::read_symlink("/proc/self/exe").parent_path() / "conceal").string();
  if (access(path.c_str(), X_OK) != 0)
    throw InputError(
        path +
        ": the generator of blind cases is not there; it is built with the tests (cmake -DBUILD_TESTING=ON, "
        "target conceal), or name it in UCHILSIM_CONCEAL");
  return path;
}

std::vector<ProvedCase> runProof(const ProofRequest& request, const EffectLibrary& library, const Analyse& analyse,
                                 const std::atomic<bool>& stop,
                                 const std::function<void(std::size_t, std::size_t)>& progress) {
  claimFolder(request);
  const auto verdictOf = [&](std::size_t number) { return (folderOf(request, number) / "verdict.json").string(); };
  std::vector<std::string> open;
  for (std::size_t number = 1; number <= request.cases; ++number)
    if (!fs::exists(verdictOf(number)) && (request.only == 0 || request.only == number))
      open.push_back(std::to_string(number));
  const std::size_t before = request.cases - open.size();
  if (progress) progress(before, request.cases);

  std::string failed;
  if (!open.empty()) {
    constexpr double longest_s = 4 * 3600;
    WorkerPool pool(
        std::max(1, std::min(request.jobs, static_cast<int>(open.size()))),
        [&](const std::string& job) {
          proveCase(request, std::stoul(job), library, analyse);
          return std::string();
        },
        longest_s);
    const auto replies = pool.run(open, stop, [&](std::size_t done) {
      if (progress) progress(before + done, request.cases);
    });
    for (std::size_t i = 0; i < replies.size(); ++i)
      if (!replies[i].ok) failed += (failed.empty() ? "case " : "; case ") + open[i] + ": " + replies[i].failure;
  }

  std::vector<ProvedCase> cases;
  for (std::size_t number = 1; number <= request.cases; ++number)
    if (const std::string path = verdictOf(number); fs::exists(path))
      cases.push_back(provedFromJson(readFile(path), path));
  writeProof(request.out, score(cases), cases);
  // A world that cannot be simulated, say: the others count all the same.
  if (!failed.empty())
    throw InputError(failed + "; the " + std::to_string(cases.size()) + " of " + std::to_string(request.cases) +
                     " that are finished are counted in " + (fs::path(request.out) / "proof.txt").string());
  return cases;
}

}  // namespace btr
