// Cases of earlier proofs that the analysis got wrong once, and that a scene made by hand does not show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/gap/analysis.h"
#include "tests/gap/temporary_folder.h"
#include "tests/prove/prove_fixture.h"

namespace btr::prove {
namespace {

/// What the analysis makes of a case's folder, from `effects` alone.
GapReport analysed(const BlindCase& blind, const Plugins& plugins, const std::vector<std::string>& effects) {
  const TemporaryFolder folder;
  writeCase(blind, plugins.library, folder.file("."));
  GapProblem problem;
  problem.scene = loadScene(folder.file("scene.json"));
  problem.models = loadModels(problem.scene);
  for (int trial = 1; std::filesystem::exists(folder.file("trial_" + std::to_string(trial) + ".csv")); ++trial)
    problem.recordings.push_back(loadRecording(folder.file("trial_" + std::to_string(trial) + ".csv")));
  AnalysisOptions options;
  options.effects = effects;
  return analyse(problem, {plugins.library.make, plugins.library.names}, options);
}

std::vector<std::string> namedIn(const GapReport& report) {
  std::vector<std::string> named;
  for (const GapReport::Effect& effect : report.tried) {
    if (!effect.accepted) continue;
    named.push_back(effect.effect);
    for (const GapReport::Rival& rival : effect.rivals) named.push_back("or " + rival.effect);
  }
  return named;
}

// A weight beside a small arm, and a servo of which nothing is trusted: gravity that leans and a stronger servo are the
// same law. A fit of the weight that began far away ended in a side minimum, so that only gravity was named.
TEST(Mended, AWeightBesideAnArmIsNotToldFromGravityThatLeans) {
  const Plugins plugins;
  const BlindCase blind = drawCase({20261150, 1, "ode", "pendulum", ""}, plugins.library);
  ASSERT_EQ(blind.answer.hidden.at(0).placed.effect, "payload");
  const GapReport report = analysed(blind, plugins, {"gravity_tilt", "payload", "position_offset"});
  EXPECT_THAT(namedIn(report), testing::AnyOf(testing::ElementsAre("gravity_tilt", "or payload"),
                                              testing::ElementsAre("payload", "or gravity_tilt")))
      << toPlainText(report);
}

// Dry friction that stops a weak servo again and again: a fit of it alone ended in a side minimum, and friction that is
// larger at rest, with two numbers more, was named.
TEST(Mended, DryFrictionIsFoundFromTheRicherFrictionThatContainsIt) {
  const Plugins plugins;
  const BlindCase blind = drawCase({20261148, 12, "ode", "pendulum", ""}, plugins.library);
  ASSERT_EQ(blind.answer.hidden.at(0).placed.effect, "coulomb_friction");
  const GapReport report = analysed(blind, plugins, {"stribeck_friction", "coulomb_friction"});
  EXPECT_THAT(namedIn(report), testing::ElementsAre("coulomb_friction")) << toPlainText(report);
}

}  // namespace
}  // namespace btr::prove
