#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/prove/prove_fixture.h"
#include "tests/temporary_folder.h"

namespace btr::prove {

/// The world and the true numbers of a case with these hidden in it, whatever the generator would hide there now.
inline BlindCase caseHiding(const std::vector<PlacedEffect>& hidden, const CaseRequest& request,
                            const Plugins& plugins) {
  BlindCase blind = drawCase(request, plugins.library);
  blind.simulator.effects = hidden;
  return blind;
}

/// What the open folder of a case says.
inline GapProblem problemOf(const BlindCase& blind, const Plugins& plugins) {
  const TemporaryFolder folder;
  writeCase(blind, plugins.library, folder.file("."));
  GapProblem problem;
  problem.scene = loadScene(folder.file("scene.json"));
  problem.models = loadModels(problem.scene);
  for (int trial = 1; std::filesystem::exists(folder.file("trial_" + std::to_string(trial) + ".csv")); ++trial)
    problem.recordings.push_back(loadRecording(folder.file("trial_" + std::to_string(trial) + ".csv")));
  return problem;
}

/// What a report names, each effect followed by its rivals.
inline std::vector<std::string> namedIn(const GapReport& report) {
  std::vector<std::string> named;
  for (const GapReport::Effect& effect : report.tried) {
    if (!effect.accepted) continue;
    named.push_back(effect.effect);
    for (const GapReport::Rival& rival : effect.rivals) named.push_back("or " + rival.effect);
  }
  return named;
}

}  // namespace btr::prove
