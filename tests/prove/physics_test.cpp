// The true simulator must reproduce its own recordings at the noise floor, at half the step that the scene's author
// chose, who knows nothing of what is concealed (an analysis goes down to an eighth where it needs to): else an analyst
// would have to find physics in what is the integrator's own error.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "tests/prove/outside_effects.h"
#include "tests/prove/prove_fixture.h"
#include "tests/prove/reality.h"
#include "tests/temporary_folder.h"

namespace btr::prove {
namespace {

/// Mean squared error in noise floors of the true simulator over all trials and columns.
struct Chi {
  double fromTrueStart = 0;  ///< begins exactly where reality was
  double firstWindow = 0;    ///< the same, the first half second alone: as long as a window of a free robot
  double ofTheStep = 0;      ///< mean square there of what half the step changes, in noise floors
  double fromSamples = 0;    ///< begins where the first samples say
};

Chi replayTruth(const BlindCase& blind, const Plugins& plugins) {
  const TemporaryFolder folder;
  writeCase(blind, plugins.library, folder.file("case"));
  const SceneSpec spec = loadScene(folder.file("case/scene.json"));
  Scene scene = makeScene(spec, loadModels(spec), blind.simulator, withOutside(plugins.library.make));
  scene.step_s /= 2;
  Scene fine = scene;
  fine.step_s = blind.world.fineStep_s;
  Scene finer = scene;
  finer.step_s /= 2;
  double exact = 0, sampled = 0, count = 0, early = 0, earlyCount = 0, stepped = 0;
  for (std::size_t i = 0; i < blind.world.trials.size(); ++i) {
    const Recording recording = loadRecording(folder.file("case/trial_" + std::to_string(i + 1) + ".csv"));
    const Binding binding = bind(scene, recording);
    // What the sensors said, as replays take a start.
    const StartState known = simulateOde(fine, blind.world.trials[i], blind.world.columns).start;
    const StartState estimated = startState(scene, recording, binding);
    const auto one = replayRecording(scene, recording, binding, known);
    const auto other = replayRecording(scene, recording, binding, estimated);
    const auto halved = replayRecording(finer, recording, binding, known);
    EXPECT_EQ("", one.fault);
    for (std::size_t c = 0; c < binding.measured.size(); ++c) {
      const std::size_t column = binding.measured[c].column;
      const double unit = blind.answer.noise.at(recording.channels[column]);
      for (std::size_t row = 0; row < recording.rows(); ++row) {
        const double value = recording.columns[column][row];
        const double square = std::pow((one.values[c][row] - value) / unit, 2);
        exact += square;
        if (recording.columns[0][row] <= 0.5) {
          early += square;
          stepped += std::pow((one.values[c][row] - halved.values[c][row]) / unit, 2);
          earlyCount += 1;
        }
        sampled += std::pow((other.values[c][row] - value) / unit, 2);
        count += 1;
      }
    }
  }
  return {exact / count, early / earlyCount, stepped / earlyCount, sampled / count};
}

class TrueSimulator : public testing::TestWithParam<std::string> {};

TEST_P(TrueSimulator, ReproducesItsRecordingsAtTheNoiseFloor) {
  const Plugins plugins;
  // Feet that land a millisecond apart walk elsewhere in the end: of a walk only as much counts here as an analysis
  // simulates at a time, the rest is printed. Where landings are a matter of the step even there, no more is asked for
  // than the step itself is sure of.
  const bool walks = GetParam() == "walk";
  constexpr double most = 1.15;
  for (const char* kind : {"nothing", "one"})
    for (std::uint64_t number = 1; number <= 3; ++number) {
      const BlindCase blind = caseOf(plugins, GetParam(), kind, number);
      const std::string hidden = blind.answer.hidden.empty() ? "" : blind.answer.hidden[0].placed.effect;
      const Chi chi = replayTruth(blind, plugins);
      std::printf(
          "%-9s %-8s case %d  step %g ms  chi2 %.3f from the true start (first half second %.3f, of it the step "
          "%.3f), %.3f from the samples'  %s\n",
          GetParam().c_str(), kind, static_cast<int>(number), 1e3 * blind.world.scene.step_s, chi.fromTrueStart,
          chi.firstWindow, chi.ofTheStep, chi.fromSamples, hidden.c_str());
      EXPECT_GT(chi.fromTrueStart, 0.9);
      if (walks)
        EXPECT_LT(chi.firstWindow, most + chi.ofTheStep);
      else
        EXPECT_LT(chi.fromTrueStart, most);
    }
}

TEST(OtherEngine, AgreesOnARigThatHasNoContactsWithinATenthOfTheNoise) {
  if (!hasMujoco()) GTEST_SKIP() << "MuJoCo is not installed";
  const Plugins plugins;
  for (const char* kind : {"nothing", "one"}) {
    const BlindCase blind = caseOf(plugins, "pendulum", kind, 2);  // "one": Coulomb friction
    Scene scene = makeScene(blind.world.scene, blind.world.models, blind.simulator, withOutside(plugins.library.make));
    scene.step_s = blind.world.fineStep_s;
    const TrialPlan& plan = blind.world.trials[0];
    const Truth ours = simulateOde(scene, plan, blind.world.columns);
    const Truth theirs = simulateMujoco(scene, plan, blind.world.columns);
    double squares = 0;
    for (std::size_t row = 0; row < plan.rows; ++row)
      squares += std::pow((ours.values[0][row] - theirs.values[0][row]) / blind.world.columns[0].floor(), 2);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(plan.rows)), 0.1) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TrueSimulator, testing::ValuesIn(sceneKinds()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace btr::prove
