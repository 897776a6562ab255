// The seal, the noise, and what an analyst gets.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/gap/recordings/recording.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "tests/prove/outside_effects.h"
#include "tests/prove/prove_fixture.h"
#include "tests/prove/reality.h"
#include "tests/temporary_folder.h"

namespace btr::prove {
namespace {

/// Standard output of the generator's program.
std::string conceal(const std::string& arguments) {
  FILE* pipe = popen((std::string(CONCEAL_PROGRAM) + " " + arguments).c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  EXPECT_EQ(0, pclose(pipe));
  return text;
}

TEST(Seal, IsTheHashOfTheAnswerThatIsOpenedLater) {
  const TemporaryFolder folder;
  const std::string which = "--seed 9 --case 4 --scene pendulum --kind one";
  const std::string seal = conceal("make " + which + " --out " + folder.file("case"));
  const std::string answer = conceal("open " + which);
  EXPECT_EQ(sha256(answer) + "\n", seal);
  EXPECT_EQ(1u, answerFromJson(answer, "answer").hidden.size());
}

TEST(Seal, TheFolderSaysNothingOfTheAnswer) {
  const Plugins plugins;
  const TemporaryFolder folder;
  const BlindCase blind = caseOf(plugins, "pendulum", "one", 2);
  writeCase(blind, plugins.library, folder.file("case"));
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("case"))) {
    names.insert(entry.path().filename().string());
    EXPECT_EQ(std::string::npos, readFile(entry.path().string()).find(blind.answer.hidden.at(0).placed.effect));
  }
  EXPECT_EQ(
      (std::set<std::string>{"rig.urdf", "scene.json", "trial_1.csv", "trial_2.csv", "trial_3.csv", "trial_4.csv"}),
      names);
}

TEST(Cases, TheSameOneIsTheSameBytesAndAnotherDiffers) {
  const Plugins plugins;
  const auto bytes = [&](std::uint64_t number) {
    const BlindCase blind = caseOf(plugins, "flight", "parameters", number);
    std::string all = toJsonText(blind.answer) + toJsonText(blind.world.scene);
    for (const std::string& text : recordTrials(blind, plugins.library)) all += text;
    return all;
  };
  EXPECT_EQ(bytes(3), bytes(3));
  EXPECT_NE(bytes(3), bytes(4));
  EXPECT_NE(caseOf(plugins, "flight", "nothing", 3).answer.salt, caseOf(plugins, "flight", "nothing", 4).answer.salt);
}

TEST(Cases, AWorldInWhichNothingActsIsDrawnAnew) {
  Plugins plugins;
  // Acts where the ball bounces; restitution itself is a number that is calibrated there, and costs nothing beside it.
  plugins.library.names = {"restitution_by_speed"};
  constexpr std::uint64_t seed = 41;
  std::uint64_t number = 1;
  const auto bounces = [](const BlindWorld& world) { return world.given.count("floor.restitution") > 0; };
  const auto firstWorld = [&] {
    Random random = Random::forPurpose(seed, "world", number);
    return drawWorld("flight", random);
  };
  while (bounces(firstWorld())) ++number;
  const BlindCase blind = drawCase({.seed = seed, .number = number, .scene = "flight", .kind = "one"}, plugins.library);
  EXPECT_TRUE(bounces(blind.world));
  ASSERT_FALSE(blind.answer.hidden.empty());
  for (const auto& hidden : blind.answer.hidden) EXPECT_GE(hidden.cost, 1);
}

TEST(Cases, NothingWrongMeansTheTrueNumbersAndParametersMeansATruthUpToAFifthAway) {
  const Plugins plugins;
  const auto numbers = [&](const char* kind) {
    const BlindCase blind = caseOf(plugins, "leg", kind, 1);
    const Scene scene = makeScene(blind.world.scene, blind.world.models, {}, {});
    std::vector<double> ratios;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::string path = "robots.leg.servos." + scene.robots[0].model.joints[j].name + ".p";
      ratios.push_back(blind.answer.truth.at(path) / scene.robots[0].drives[j].p);
    }
    return ratios;
  };
  EXPECT_EQ((std::vector<double>{1, 1, 1}), numbers("nothing"));
  for (const double ratio : numbers("parameters")) {
    EXPECT_NE(1, ratio);
    EXPECT_NEAR(1, ratio, 0.2);
  }
}

TEST(Cases, AnswersSurviveBeingWrittenAndRead) {
  const Plugins plugins;
  const ConcealedAnswer answer = caseOf(plugins, "carpet", "two", 1).answer;
  EXPECT_EQ(2u, answer.hidden.size());
  EXPECT_EQ(toJsonText(answer), toJsonText(answerFromJson(toJsonText(answer), "answer")));
}

TEST(Noise, IsNormalOfTheSizeThatWasDrawn) {
  const Plugins plugins;
  const TemporaryFolder folder;
  const BlindCase blind = caseOf(plugins, "pendulum", "nothing", 5);
  writeCase(blind, plugins.library, folder.file("case"));
  Scene fine = makeScene(blind.world.scene, blind.world.models, blind.simulator, withOutside(plugins.library.make));
  fine.step_s = blind.world.fineStep_s;
  const MeasuredColumn& column = blind.world.columns[0];
  double sum = 0, squares = 0, fourths = 0, count = 0;
  for (std::size_t i = 0; i < blind.world.trials.size(); ++i) {
    const Recording recording = loadRecording(folder.file("case/trial_" + std::to_string(i + 1) + ".csv"));
    const auto& recorded = recording.columns[static_cast<std::size_t>(recording.column(column.name))];
    const Truth truth = simulateOde(fine, blind.world.trials[i], blind.world.columns);
    for (std::size_t row = 0; row < recorded.size(); ++row) {
      const double error = (recorded[row] - truth.values[0][row]) / column.floor();
      sum += error;
      squares += error * error;
      fourths += std::pow(error, 4);
      count += 1;
    }
  }
  // Standard errors of mean and variance of normal noise are 1/√n and √(2/n): five of them. Rounding flattens it.
  EXPECT_NEAR(0, sum / count, 5 / std::sqrt(count));
  EXPECT_NEAR(1, squares / count, 5 * std::sqrt(2 / count));
  EXPECT_NEAR(3, fourths / count, 0.9);
}

TEST(OutsideEffects, AreUnknownToTheLibraryAndDoNothingAtNeutral) {
  const Plugins plugins;
  const EffectFactory effects = withOutside(plugins.library.make);
  for (const std::string& name : outsideNames()) {
    EXPECT_EQ(0, std::count(plugins.library.names.begin(), plugins.library.names.end(), name)) << name;
    const auto effect = effects(name);
    std::vector<double> values;
    for (const Parameter& parameter : effect->parameters())
      values.push_back(parameter.neutral ? *parameter.neutral : parameter.byDefault);
    const JointState joint{.time = 0.3, .position = 0.7, .rate = -2};
    BallState ball;
    ball.position_m = {0.4, 0.1, 0.04};
    ball.velocity_m_s = {1, 0, 0};
    ball.mass_kg = 0.05;
    ball.onFloor = true;
    EXPECT_EQ(0, effect->torque(joint, values)) << name;
    EXPECT_EQ(0, effect->frictionLimit(joint, values)) << name;
    EXPECT_EQ(0, effect->ballForce(ball, values).norm()) << name;
  }
}

}  // namespace
}  // namespace btr::prove
