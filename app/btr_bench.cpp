// btr bench: speed of the simulator on this machine.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "app/btr_live_bench.h"
#include "core/sim/bench.h"
#include "core/spec/error.h"

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

void bench(const std::string& folder, int repeats, Shell& shell) {
  const fs::path scenes = folder.empty() ? ownScenes() : fs::path(folder);
  const SceneSpec walk = loadScene((scenes / "walk.json").string());
  const SceneSpec kick = loadScene((scenes / "kick.json").string());
  const auto controller = shell.plugins().controller("kick");
  const bool show = isatty(STDERR_FILENO);
  std::vector<BenchResult> results;
  for (const BenchTask& task : {walkTask(walk, loadModels(walk)), kickTask(kick, loadModels(kick), *controller)}) {
    if (*shell.stop) break;
    const auto progress = [show](const std::string& line) {
      if (show) std::fprintf(stderr, "\r%s \x1b[K", line.c_str());
    };
    results.push_back(benchmark(task, repeats, progress, [&shell] { return !*shell.stop; }));
  }
  if (show) std::fprintf(stderr, "\r\x1b[K");
  if (shell.json) {
    nlohmann::json all = nlohmann::json::array();
    for (const BenchResult& result : results) all.push_back(toJson(result));
    printJson(all);
  } else {
    std::cout << benchTable(results);
  }
  if (*shell.stop) shell.exitCode = stoppedEarly;
}

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
  struct Arguments {
    std::string scenes;
    int repeats = 3;
    bool live = false;
    double seconds = 20;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("bench", "speed of the simulator on this machine, one table");
  command->add_option("--scenes", a->scenes, "folder of walk.json and kick.json (default: those of the program)");
  command->add_option("--repeats", a->repeats, "times each trial is run; the fastest counts")
      ->transform(wholeNumber(1, 1000));
  CLI::Option* live = command->add_flag("--live", a->live, "running worlds: share of a core, real-time factor, memory");
  command->add_option("--seconds", a->seconds, "with --live, how long each world runs, simulated [s]")
      ->transform(decimalNumber(1, 1e6))
      ->capture_default_str()
      ->needs(live);
  command->callback(
      [a, &shell] { a->live ? benchLive(a->scenes, a->seconds, shell) : bench(a->scenes, a->repeats, shell); });
}

}  // namespace btr::cli
