// btr bench: speed of the simulator on this machine.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
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

}  // namespace

void addBenchCommand(CLI::App& app, Shell& shell) {
  struct Arguments {
    std::string scenes;
    int repeats = 3;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("bench", "speed of the simulator on this machine, one table");
  command->add_option("--scenes", a->scenes, "folder of walk.json and kick.json (default: those of the program)");
  command->add_option("--repeats", a->repeats, "times each trial is run; the fastest counts")
      ->transform(wholeNumber(1, 1000));
  command->callback([a, &shell] { bench(a->scenes, a->repeats, shell); });
}

}  // namespace btr::cli
