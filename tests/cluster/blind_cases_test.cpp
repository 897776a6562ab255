// Blind cases that others prove: the files of one process, whoever proves them and whoever is killed.
#include "core/cluster/blind_cases.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>

#include "core/cluster/array_job.h"
#include "core/cluster/coordinator.h"
#include "core/gap/proof/proof_case.h"
#include "core/gap/proof/proof_run.h"
#include "core/spec/json_reader.h"
#include "tests/cluster/descendants.h"
#include "tests/cluster/foremen.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace {

using namespace btr;
namespace fs = std::filesystem;
using test::goOn;
using test::withForemen;

/// Content of every file below a folder by its name, but for how long things took and where the folder is.
std::map<std::string, std::string> contentOf(const fs::path& folder) {
  static const std::regex seconds(
      "\"(wall_time_s|(median_)?seconds)\": [^,\n]*|, seed [0-9]+, [0-9.e-]+ s|time of an analysis, median.*"),
      secondsInTables("(<td>| +)[0-9.]+(</td></tr>|\n)");
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string text = std::regex_replace(readFile(entry.path().string()), seconds, "");
    if (entry.path().stem() == "proof") text = std::regex_replace(text, secondsInTables, "$2");
    for (std::size_t at = text.find(folder.string()); at != std::string::npos; at = text.find(folder.string()))
      text.replace(at, folder.string().size(), "TRIAL");
    files[entry.path().lexically_relative(folder).string()] = std::move(text);
  }
  return files;
}

/// A trial of pendulums without anything hidden: its cases take a part of a second.
class Trial {
 public:
  explicit Trial(const std::string& out, std::size_t cases = 3) {
    request.generator = CONCEAL_PROGRAM;
    request.out = request.place = out;
    request.seed = 5;
    request.cases = cases;
    request.scene = "pendulum";
    request.kind = "nothing";
    request.options.designNext = false;
    setenv("UCHILSIM_CONCEAL", CONCEAL_PROGRAM, 1);
  }
  std::vector<ProvedCase> run(const std::atomic<bool>& stop = goOn,
                              const std::function<void(std::size_t, std::size_t)>& progress = {}) const {
    const EffectLibrary library{host().effectFactory(), host().effects()};
    return runProof(
        request, library,
        [](const AnalysisRequest& asked, const EffectLibrary& effects) { return runAnalysis(asked, effects); }, stop,
        progress);
  }
  static const PluginHost& host() {
    static const PluginHost plugins(PLUGIN_DIR);
    return plugins;
  }
  ProofRequest request;
};

std::map<std::string, std::string> ofOneProcess(const TemporaryFolder& folder, std::size_t cases = 3) {
  const std::string out = folder.file("alone");
  EXPECT_EQ(cases, Trial(out, cases).run().size());
  return contentOf(out);
}

/// Lines of both where they part.
std::string firstDifference(const std::string& a, const std::string& b) {
  const auto at = static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
  const auto line = [&](const std::string& text) {
    const std::size_t from = text.rfind('\n', at) + 1;  // npos + 1 is 0
    return text.substr(from, text.find('\n', at) - from);
  };
  return line(a) + " / " + line(b);
}

/// The same files; only what differs is shown.
void expectSame(const std::map<std::string, std::string>& alone, const std::map<std::string, std::string>& others) {
  for (const auto& [name, content] : alone) {
    const auto other = others.find(name);
    if (other == others.end())
      ADD_FAILURE() << name << " is missing";
    else
      EXPECT_TRUE(content == other->second) << name << ": " << firstDifference(content, other->second);
  }
  EXPECT_EQ(alone.size(), others.size());
}

TEST(BlindCases, AreTheFilesOfOneProcessWhateverTheNumberOfForemen) {
  const TemporaryFolder folder;
  const auto alone = ofOneProcess(folder);
  EXPECT_TRUE(alone.contains("case_003/analysis/report.json"));
  for (const int foremen : {1, 3}) {
    Trial trial(folder.file("foremen-" + std::to_string(foremen)));
    Coordinator coordinator(nullptr, Trial::host(), withForemen(foremen));
    trial.request.force = &coordinator;
    EXPECT_EQ(3u, trial.run().size());
    expectSame(alone, contentOf(trial.request.out));
  }
}

TEST(BlindCases, AreTheSameWhenTheirProcessesAreKilled) {
  const TemporaryFolder folder;
  const auto alone = ofOneProcess(folder, 6);
  Trial trial(folder.file("killed"), 6);
  Coordinator coordinator(nullptr, Trial::host(), withForemen(2));
  trial.request.force = &coordinator;
  int killed = 0;
  trial.run(goOn, [&](std::size_t, std::size_t) {
    // Foremen first, then workers: one of each, and never one job three times.
    const std::vector<pid_t> all = test::descendants();
    if (killed == 2 || all.empty()) return;
    kill(killed == 0 ? all.front() : all.back(), SIGKILL);
    ++killed;
  });
  EXPECT_EQ(2, killed);
  expectSame(alone, contentOf(trial.request.out));
}

TEST(BlindCases, ThatAreStoppedKeepWhatIsFinishedAndGoOn) {
  const TemporaryFolder folder;
  const auto alone = ofOneProcess(folder, 4);
  Trial trial(folder.file("stopped"), 4);
  std::atomic<bool> stop{false};
  {
    Coordinator coordinator(nullptr, Trial::host(), withForemen(1));
    trial.request.force = &coordinator;
    const auto first = trial.run(stop, [&](std::size_t done, std::size_t) { stop = done > 0; });
    EXPECT_GE(first.size(), 1u);
    EXPECT_LT(first.size(), 4u);
  }
  const std::vector<std::size_t> open = openCases(trial.request);
  Coordinator coordinator(nullptr, Trial::host(), withForemen(2));
  trial.request.force = &coordinator;
  EXPECT_EQ(4u, trial.run().size());
  long proved = 0;
  for (const PlaceReport& place : coordinator.report()) proved += place.jobs;
  EXPECT_EQ(static_cast<long>(open.size()), proved);
  expectSame(alone, contentOf(trial.request.out));
}

TEST(BlindCases, WithoutTheirGeneratorAreRefusedByNameAndHost) {
  const TemporaryFolder folder;
  Trial trial(folder.file("trial"));
  setenv("UCHILSIM_CONCEAL", "/nowhere/conceal", 1);
  Coordinator coordinator(nullptr, Trial::host(), withForemen(1));
  trial.request.force = &coordinator;
  const std::string said = test::refusal([&] { trial.run(); });
  EXPECT_TRUE(
      said.starts_with("rank 0 (host " + hostName() + "): /nowhere/conceal: the generator of blind cases is not there"))
      << said;
}

TEST(BlindCases, OfAnotherGeneratorAreRefused) {
  const TemporaryFolder folder;
  Trial trial(folder.file("trial"));
  const std::string other = folder.file("conceal");
  fs::copy_file(CONCEAL_PROGRAM, other);
  writeFile(folder.file("more"), readFile(other, std::size_t{1} << 30) + "x");
  fs::permissions(folder.file("more"), fs::perms::owner_all);
  setenv("UCHILSIM_CONCEAL", folder.file("more").c_str(), 1);
  Coordinator coordinator(nullptr, Trial::host(), withForemen(1));
  trial.request.force = &coordinator;
  EXPECT_EQ(
      "rank 0 (host " + hostName() + "): its program conceal is another one; install the same build on every machine",
      test::refusal([&] { trial.run(); }));
}

// A place that cannot write would fail all cases that are left, one after another. Files are limited for those that
// are started from here on.
TEST(BlindCases, EndWithOneSentenceWhereAMachineHasNoRoom) {
  const TemporaryFolder folder;
  Trial trial(folder.file("trial"));
  Coordinator coordinator(nullptr, Trial::host(), withForemen(1));
  trial.request.force = &coordinator;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  constexpr rlim_t fewBytes = 20000;
  const rlimit little{fewBytes, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  const std::string said = test::refusal([&] { trial.run(); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(said.starts_with("host " + hostName() + ": ")) << said;
  EXPECT_TRUE(said.ends_with("what is finished is kept: with room there, the same command goes on")) << said;
  EXPECT_EQ(3u, openCases(trial.request).size());
}

// ---- elements of an array job

/// A finished case as far as packing looks at it.
void makeCase(const fs::path& trial, std::size_t number, bool finished) {
  const fs::path folder = trial / nameOfCase(number);
  fs::create_directories(folder / "analysis");
  writeFile((folder / "analysis" / "report.json").string(), "report " + std::to_string(number));
  if (finished) writeFile((folder / "verdict.json").string(), "verdict");
}

TEST(ElementCases, GoAndComeWithoutThoseThatAreNotFinished) {
  const TemporaryFolder folder;
  const fs::path trial = folder.file("trial");
  makeCase(trial, 3, true);
  makeCase(trial, 4, false);
  makeCase(trial, 5, true);
  writeFile((trial / "trial.json").string(), "trial");
  writeFile((trial / "proof.txt").string(), "of this element alone");
  packCases(trial.string(), folder.file("1.tar"));
  unpackCases(folder.file("1.tar"), folder.file("back"));
  const auto back = contentOf(folder.file("back"));
  EXPECT_EQ(5u, back.size());
  EXPECT_EQ("report 5", back.at("case_005/analysis/report.json"));
  EXPECT_EQ("trial", back.at("trial.json"));
  EXPECT_EQ(2u, finishedCases(folder.file("back"), {3, 4, 5}));
}

TEST(ElementCases, BeginWithNone) {
  const TemporaryFolder folder;
  packCases("", folder.file("1.tar"));
  unpackCases(folder.file("1.tar"), folder.file("back"));
  EXPECT_TRUE(fs::is_empty(folder.file("back")));
}

/// A job of two elements; the first has cases 1 and 2, the second 3, which it did not finish.
ArrayJob jobOf(const TemporaryFolder& folder, const std::string& into) {
  ArrayJob job;
  job.what = "gap prove";
  job.into = into;
  job.elements = {{"cases 1 to 2", {}, {1, 2}}, {"case 3", {}, {3}}};
  fs::create_directories(folder.file("job"));
  saveArrayJob(folder.file("job"), job);
  return job;
}

TEST(ElementCases, AreCollectedIntoTheTrialAndCountedAsOnOneMachine) {
  const TemporaryFolder folder;
  const auto alone = ofOneProcess(folder);
  // What its two elements came to, each on its machine.
  for (const auto& [element, only] :
       {std::pair<std::size_t, std::pair<std::size_t, std::size_t>>{1, {1, 2}}, {2, {3, 3}}}) {
    Trial part(folder.file("machine-" + std::to_string(element)));
    part.request.place = folder.file("collected");
    part.request.from = only.first;
    part.request.to = only.second;
    part.run();
    jobOf(folder, folder.file("collected"));
    packCases(part.request.out, elementCases(folder.file("job"), element));
    saveElementState(folder.file("job"), element, {element == 1 ? "done" : "failed", "", "", 1});
  }
  // Cases that a failed element has finished count all the same.
  const Collected first = collectArray(folder.file("job"));
  EXPECT_EQ(1u, first.fresh);
  EXPECT_EQ(std::vector<std::size_t>{2}, first.missing);
  expectSame(alone, contentOf(folder.file("collected")));
  EXPECT_EQ(1u, collectArray(folder.file("job")).before);
}

TEST(ElementCases, OfAnotherTrialAreRefused) {
  const TemporaryFolder folder;
  const fs::path trial = folder.file("machine"), into = folder.file("collected");
  makeCase(trial, 1, true);
  writeFile((trial / "trial.json").string(), "seed 1");
  fs::create_directories(into);
  writeFile((into / "trial.json").string(), "seed 2");
  jobOf(folder, into.string());
  packCases(trial.string(), elementCases(folder.file("job"), 1));
  saveElementState(folder.file("job"), 1, {"done", "", "", 1});
  const std::string said = test::refusal([&] { collectArray(folder.file("job")); });
  EXPECT_NE(std::string::npos, said.find("the one that the job's cases belong to")) << said;
  EXPECT_FALSE(fs::exists(into / "case_001"));
}

TEST(ElementCases, AreNamedInTheJobsFile) {
  const TemporaryFolder folder;
  jobOf(folder, folder.file("collected"));
  EXPECT_EQ((std::vector<std::size_t>{1, 2}), loadArrayJob(folder.file("job")).elements[0].cases);
}

}  // namespace
