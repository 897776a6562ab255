// btr bench: speed on this machine, all of it in one table.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/bench/btr_bench_rows.h"
#include "app/bench/btr_live_bench.h"
#include "app/btr_commands.h"
#include "core/sim/bench/bench.h"
#include "core/spec/error.h"
#include "core/store/database.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

/// The scenes that come with the program: resources/scenes, or share/uchilsim/scenes of an installed program, in a
/// folder above the executable.
fs::path ownScenes() {
  for (fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();; folder = folder.parent_path()) {
    for (const char* scenes : {"share/uchilsim/scenes", "resources/scenes"})
      if (fs::exists(folder / scenes / "kick.json")) return folder / scenes;
    if (folder == folder.parent_path())
      throw InputError(
          "btr bench: resources/scenes/kick.json was not found above the program; name its folder with --scenes");
  }
}

nlohmann::json toJson(const BenchResult& result) {
  nlohmann::json steps = nlohmann::json::array();
  for (const BenchStep& s : result.steps)
    steps.push_back({{"step_s", s.step_s},
                     {"near_substeps", s.nearSubsteps},
                     {"outcome_m", s.outcome_m},
                     {"deviation", s.deviation},
                     {"rms_deviation", s.rmsDeviation},
                     {"cpu_per_simulated", s.cpuPerSimulated},
                     {"trials_per_second", s.trialsPerSecond}});
  return {{"task", result.name},
          {"chosen", result.chosen},
          {"converged_outcome_m", result.converged.outcome_m},
          {"steps", steps}};
}

struct BenchArguments {
  std::string scenes;
  int repeats = 3, individuals = 50'000;
  bool live = false;
  double seconds = 20;
  std::vector<std::string> parts;
};

const std::vector<std::string> allParts{"walk", "kick", "setup", "batch", "gap", "database", "live", "mpi"};

/// Each part in its turn, until the user stops.
class Bench {
 public:
  Bench(const BenchArguments& arguments, Shell& shell)
      : arguments_(arguments),
        shell_(shell),
        scenes_(arguments.scenes.empty() ? ownScenes() : fs::path(arguments.scenes)),
        work_{.host = shell.plugins(),
              .resources = scenes_.parent_path().string(),
              .program = fs::read_symlink("/proc/self/exe").string(),
              .repeats = arguments.repeats,
              .individuals = arguments.individuals,
              .seconds = arguments.seconds,
              .goesOn = [&shell] { return !*shell.stop; },
              .progress =
                  [](const std::string& line) {
                    if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r%s \x1b[K", line.c_str());
                  }} {}

  void all() {
    const SceneSpec kickScene = loadScene((scenes_ / "kick.json").string());
    const SceneSpec walkScene = loadScene((scenes_ / "walk.json").string());
    const auto controller = shell_.plugins().controller("kick");
    const BenchTask kick = kickTask(kickScene, loadModels(kickScene), *controller);
    part("walk", [&] { return measured(walkTask(walkScene, loadModels(walkScene))); });
    part("kick", [&] { return measured(kick); });
    part("setup", [&] { return setUpRows(kick, work_); });
    part("batch", [&] { return batchRows(work_); });
    part("gap", [&] { return gapRows(work_); });
    part("database", [&] { return databaseRows(work_); });
    part("live", [&] { return liveRows(work_); });
    part("mpi", [&] { return mpiRows(work_); });
    if (isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\x1b[K");
    print();
    if (*shell_.stop) shell_.exitCode = stoppedEarly;
  }

 private:
  template <class Measure>
  void part(const std::string& name, const Measure& measure) {
    const std::vector<std::string>& wanted = arguments_.parts;
    if (*shell_.stop || (!wanted.empty() && std::ranges::find(wanted, name) == wanted.end())) return;
    work_.progress(name);
    for (BenchRow& row : measure()) rows_.push_back(std::move(row));
  }
  std::vector<BenchRow> measured(const BenchTask& task) {
    results_.push_back(benchmark(task, work_.repeats, work_.progress, work_.goesOn));
    return taskRows(task, results_.back(), work_);
  }
  void print() const {
    const nlohmann::json machine = benchMachine();
    if (shell_.json) {
      nlohmann::json rows = nlohmann::json::array(), tasks = nlohmann::json::array();
      for (const BenchRow& row : rows_) rows.push_back(toJson(row));
      for (const BenchResult& result : results_) tasks.push_back(toJson(result));
      return printJson({{"format", "uchilsim-bench-1"},
                        {"version", programVersion()},
                        {"machine", machine},
                        {"rows", rows},
                        {"tasks", tasks}});
    }
    std::cout << benchRowsTable(rows_) << '\n';
    if (!results_.empty()) std::cout << benchTable(results_) << '\n';
    std::printf("btr %s on %d processors, %s; load %.1f. Other engines, interleaved: bench_engines of tests/bench.\n",
                programVersion().c_str(), machine["processors"].get<int>(),
                machine["processor"].get<std::string>().c_str(), machine["load"].get<double>());
  }

  const BenchArguments& arguments_;
  Shell& shell_;
  const fs::path scenes_;
  const BenchWork work_;
  std::vector<BenchRow> rows_;
  std::vector<BenchResult> results_;
};

nlohmann::json toJson(const LiveBenchRow& row) {
  return {{"world", row.name},
          {"walking", row.walking},
          {"standing", row.standing},
          {"simulated_s", row.simulated_s},
          {"cpu_per_simulated", row.cpuPerSimulated},
          {"core_share_per_dog", row.perDog()},
          {"real_time_factor", row.realTimeFactor},
          {"memory_before_mb", row.before_mb},
          {"memory_after_mb", row.after_mb},
          {"memory_growth_second_half_mb", row.growth_mb},
          {"fault", row.fault}};
}

void benchLive(const std::string& folder, double seconds, Shell& shell) {
  const fs::path scenes = folder.empty() ? ownScenes() : fs::path(folder);
  const Game game = loadGame((scenes.parent_path() / "games" / "two-walkers-2004.json").string());
  const bool show = isatty(STDERR_FILENO);
  std::vector<LiveBenchRow> rows;
  for (const LiveBenchTask& task : liveBenchTasks(game)) {
    if (*shell.stop) break;
    if (show) std::fprintf(stderr, "\r%s \x1b[K", task.name.c_str());
    rows.push_back(measureLive(task, shell.plugins(), seconds, [&shell] { return !*shell.stop; }));
  }
  if (show) std::fprintf(stderr, "\r\x1b[K");
  if (shell.json) {
    nlohmann::json all = nlohmann::json::array();
    for (const LiveBenchRow& row : rows) all.push_back(toJson(row));
    printJson(all);
  } else {
    std::cout << liveBenchTable(rows);
  }
  if (*shell.stop) shell.exitCode = stoppedEarly;
}

}  // namespace

void addBenchCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<BenchArguments>();
  CLI::App* command = app.add_subcommand("bench", "speed of the simulator on this machine, one table");
  command->add_option("--scenes", a->scenes, "folder of walk.json and kick.json (default: those of the program)");
  command->add_option("--repeats", a->repeats, "times each trial is run; the fastest counts")
      ->transform(wholeNumber(1, 1000));
  CLI::Option* parts = command->add_option("--parts", a->parts, "only these")->check(CLI::IsMember(allParts));
  command->add_option("--individuals", a->individuals, "of the database that is made for a while")
      ->transform(wholeNumber(5000, 10'000'000))
      ->capture_default_str();
  command->add_flag("--live", a->live, "running worlds alone: share of a core, real-time factor, memory")
      ->excludes(parts);
  command->add_option("--seconds", a->seconds, "how long each running world runs, simulated [s]")
      ->transform(decimalNumber(1, 1e6))
      ->capture_default_str();
  command->callback([a, &shell] {
    if (a->live)
      benchLive(a->scenes, a->seconds, shell);
    else
      Bench(*a, shell).all();
  });
}

}  // namespace btr::cli
