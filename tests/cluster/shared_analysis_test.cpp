#include "core/cluster/analysis/shared_analysis.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <deque>
#include <filesystem>
#include <map>
#include <regex>
#include <thread>

#include "core/cluster/build_identity.h"
#include "core/gap/report/report_plain.h"
#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/spec/system/cancelled.h"
#include "tests/cluster/descendants.h"
#include "tests/cluster/foremen.h"
#include "tests/cluster/played_rank.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::shared_analysis_test {
namespace {

using test::descendants;

/// Times differ from one analysis to the next.
std::string withoutTimes(std::string text) {
  for (const char* time : {"\"wall_time_s\": [0-9.e-]+", ", seed [0-9]+, [0-9.e-]+ s", "[0-9.e-]+ s\n$"})
    text = std::regex_replace(text, std::regex(time), "");
  return text;
}

/// Two seconds of a joint with friction that the scene lacks.
class Hinge {
 public:
  Hinge() : host_(PLUGIN_DIR) {
    const std::string from = SOURCE_DIR "/resources/recordings/xl330-made/", name = "made_kp200_sines";
    std::string rows = readFile(from + name + ".csv");
    std::size_t end = 0;
    for (int i = 0; i < 400; ++i) end = rows.find('\n', end) + 1;
    request_.scene = SOURCE_DIR "/resources/scenes/xl330.json";
    request_.recordings = {folder_.write(name + ".csv", rows.substr(0, end))};
    folder_.write(name + ".mapping.json", readFile(from + name + ".mapping.json"));
    request_.options.effects = {"viscous_friction", "backlash", "coulomb_friction"};
  }
  const PluginHost& host() const { return host_; }
  const TemporaryFolder& folder() const { return folder_; }
  AnalysisRequest into(const std::string& name) const {
    AnalysisRequest request = request_;
    request.out = folder_.file(name);
    return request;
  }
  /// All files of a report, by name.
  std::map<std::string, std::string> files(const std::string& name) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.file(name)))
      if (entry.is_regular_file())
        all[entry.path().filename().string()] = withoutTimes(readFile(entry.path().string()));
    return all;
  }
  std::map<std::string, std::string> filesOfOneProcess() const {
    runAnalysis(into("one"), {host_.effectFactory(), host_.effects()});
    return files("one");
  }

 private:
  PluginHost host_;
  TemporaryFolder folder_;
  AnalysisRequest request_;
};

/// So many foremen of this rank, with so many workers each: ranks say the same to each other from elsewhere.
CoordinatorOptions withAnalysts(int foremen, int workers) {
  CoordinatorOptions options = test::withForemen(foremen);
  options.command.insert(options.command.end(), {"--workers", std::to_string(workers)});
  return options;
}

TEST(SharedAnalysis, WritesTheFilesOfOneProcessWhoeverWorks) {
  const Hinge hinge;
  const auto alone = hinge.filesOfOneProcess();
  EXPECT_TRUE(alone.contains("report.json") && alone.contains("simulator.json"));
  for (const auto& [foremen, workers] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{3, 1}, std::pair{2, 2}}) {
    const std::string name = std::to_string(foremen) + "x" + std::to_string(workers);
    SharedAnalysis analysis(nullptr, hinge.host(), withAnalysts(foremen, workers));
    const auto text = analysis.run(hinge.into(name), {}, test::goOn);
    EXPECT_EQ(alone, hinge.files(name)) << name;
    EXPECT_EQ(withoutTimes(readFile(hinge.folder().file(name + "/report.json"))), withoutTimes(text.json));
    EXPECT_TRUE(analysis.notes().empty());
    long jobs = 0;
    for (const PlaceReport& place : analysis.report()) {
      EXPECT_EQ(workers, place.workers);
      jobs += place.jobs;
    }
    EXPECT_EQ(foremen * workers > 1, jobs > 0) << name;
  }
}

// Whoever is killed, who leads or another, or a worker of one. The third loss of a job would rightly be refused.
TEST(SharedAnalysis, WritesTheSameFilesWhenItsProcessesAreKilled) {
  const Hinge hinge;
  const auto alone = hinge.filesOfOneProcess();
  Random random(4);
  for (int round = 0; round < 6; ++round) {
    const std::string name = "round" + std::to_string(round);
    SharedAnalysis analysis(nullptr, hinge.host(), withAnalysts(2, 1));
    int killed = 0;
    double next = random.uniform();
    const auto progress = [&](const std::string&, double share) {
      const std::vector<pid_t> all = descendants();
      if (all.empty() || killed == 2 || share < next) return true;
      kill(all[static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size()))], SIGKILL);
      next = random.uniform();
      ++killed;
      return true;
    };
    analysis.run(hinge.into(name), progress, test::goOn);
    EXPECT_EQ(alone, hinge.files(name)) << name;
  }
}

// Not who leads: without it there is no report. It is started anew where it holds a piece, else not waited for.
TEST(SharedAnalysis, DoesWithoutAForemanThatHangs) {
  const Hinge hinge;
  const auto alone = hinge.filesOfOneProcess();
  CoordinatorOptions options = withAnalysts(2, 1);
  options.secondsPerPart = 0;
  options.grace_s = 2;
  options.patience_s = 10;
  SharedAnalysis analysis(nullptr, hinge.host(), options);
  bool isStopped = false;
  const auto progress = [&](const std::string&, double) {
    if (!isStopped) kill(descendants().at(1), SIGSTOP);
    isStopped = true;
    return true;
  };
  analysis.run(hinge.into("hung"), progress, test::goOn);
  EXPECT_EQ(alone, hinge.files("hung"));
}

TEST(SharedAnalysis, WritesNothingAndLeavesNoProcessWhenItIsStopped) {
  const Hinge hinge;
  {
    SharedAnalysis analysis(nullptr, hinge.host(), withAnalysts(2, 1));
    EXPECT_THROW(analysis.run(
                     hinge.into("none"), [](const std::string&, double) { return false; }, test::goOn),
                 Cancelled);
  }
  {
    std::atomic<bool> stop{false};
    SharedAnalysis analysis(nullptr, hinge.host(), withAnalysts(2, 1));
    const auto progress = [&](const std::string&, double share) {
      stop = share > 0.3;
      return true;
    };
    EXPECT_THROW(analysis.run(hinge.into("none"), progress, stop), Cancelled);
  }
  EXPECT_FALSE(std::filesystem::exists(hinge.folder().file("none")));
  for (int i = 0; i < 10000 && !descendants().empty(); ++i) std::this_thread::yield();
  EXPECT_TRUE(descendants().empty());
}

TEST(SharedAnalysis, RefusesWhatOneProcessRefusesInTheSameWords) {
  const Hinge hinge;
  AnalysisRequest request = hinge.into("none");
  request.recordings = {hinge.folder().file("nowhere.csv")};
  const EffectLibrary library{hinge.host().effectFactory(), hinge.host().effects()};
  const std::string alone = test::refusal([&] { runAnalysis(request, library); });
  SharedAnalysis analysis(nullptr, hinge.host(), withAnalysts(2, 1));
  EXPECT_EQ(alone, test::refusal([&] { analysis.run(request, {}, test::goOn); }));
  EXPECT_NE("accepted", alone);
}

/// What is said where the rank lab7 begins, and then `says`.
std::string refusalOf(const Hinge& hinge, const Parts& says) {
  Parts hello{"0", "hello"};
  const Parts identity = buildIdentity(hinge.host());
  hello.insert(hello.end(), identity.begin(), identity.end());
  std::deque<Parts> all{{"crew", "lab7", "1", ""}, hello, says};
  SharedAnalysis analysis(std::make_unique<test::PlayedRank>(std::move(all)), hinge.host(), withAnalysts(1, 1));
  return test::refusal([&] { analysis.run(hinge.into("none"), {}, test::goOn); });
}

TEST(SharedAnalysis, NamesARankThatReadsOtherFiles) {
  const Hinge hinge;
  Parts ready{"0", "ready", "1", "1", pack({"file xl330.json 0"})};
  const Parts identity = buildIdentity(hinge.host());
  ready.insert(ready.end(), identity.begin(), identity.end());
  EXPECT_EQ("rank 1 (host lab7): its file xl330.json is another one; all machines must read the same files",
            refusalOf(hinge, ready));
}

TEST(SharedAnalysis, NamesARankThatCannotRead) {
  EXPECT_EQ("rank 1 (host lab7): trial.csv: there is no such file",
            refusalOf(Hinge(), {"0", "failed", "1", "input", "trial.csv: there is no such file"}));
}

}  // namespace
}  // namespace btr::shared_analysis_test
