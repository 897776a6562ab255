// What an analysis makes of an arm of three joints that was integrated elsewhere (strange_arm.h).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gap/fit/alignment.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/recordings/resample.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/gap/strangers/strange_arm.h"
#include "tests/plugin/built_plugins.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace arm_of_strangers {

/// The arm as its owner describes it, without recordings; its servos as JSON.
GapProblem describedArm(double step_s, const std::string& servos) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", strange::armUrdf());
  GapProblem problem;
  problem.scene = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": )" + std::to_string(step_s) +
                                    R"(, "control_period_s": 0.008, "robots": [{"name": "arm", "model": "arm.urdf",
    "base": "fixed", "position_m": [0, 0, 1], "collision": "none", "servos": {)" +
                                    servos + "}}]}",
                                "scene", folder.file("."));
  problem.models = loadModels(problem.scene);
  return problem;
}

/// Two quantities of each joint.
Recording recordingOf(const strange::ArmTrial& made, int number, const std::string& first,
                      const strange::Columns& ofFirst, const std::string& second, const strange::Columns& ofSecond) {
  Recording recording;
  recording.source = "trial_" + std::to_string(number) + ".csv";
  recording.channels = {"time_s"};
  recording.columns = {made.time};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string joint = "arm.joint" + std::to_string(i + 1);
    recording.channels.insert(recording.channels.end(), {joint + first, joint + second});
    recording.columns.insert(recording.columns.end(), {ofFirst[i], ofSecond[i]});
  }
  return recording;
}

GapProblem problemOf(const strange::Arm& arm, int trials, double noise = 3e-4) {
  GapProblem problem = describedArm(0.001, R"("joint1": {"p": 40, "d": 2, "max_torque_nm": 30},
    "joint2": {"p": 30, "d": 1.2, "max_torque_nm": 20}, "joint3": {"p": 10, "d": 0.3, "max_torque_nm": 8})");
  std::mt19937_64 random(7);
  for (int trial = 0; trial < trials; ++trial) {
    const strange::ArmTrial made = strange::SwungArm(arm).run(4, 0.008, noise, random);
    problem.recordings.push_back(
        recordingOf(made, trial, ".command_rad", made.command, ".position_rad", made.position));
  }
  return problem;
}

EffectLibrary library() { return {test::host().effectFactory(), test::host().effects()}; }

std::vector<std::string> namedIn(const GapReport& report) {
  std::vector<std::string> named;
  for (const GapReport::Effect& each : report.tried)
    if (each.accepted) named.push_back(each.effect + " at " + each.at);
  return named;
}

TEST(EveryJoint, HasWhatIsPlacedAtItsRobot) {
  const GapProblem problem = problemOf({}, 1);
  const auto placed = [&](const std::string& effect, const std::string& at) {
    return makeScene(problem.scene, problem.models, {{}, {{effect, at, {}}}}, library().make);
  };
  std::vector<std::string> places;
  for (const SceneEffect& effect : placed("coulomb_friction", "arm.*").effects) places.push_back(effect.at);
  EXPECT_THAT(places, testing::ElementsAre("arm.joint1", "arm.joint2", "arm.joint3"));
  const Scene bare = placed("coulomb_friction", "arm.joint1"), heavy = placed("rotor_inertia", "arm.*");
  for (std::size_t joint = 0; joint < 3; ++joint)
    EXPECT_GT(heavy.robots[0].drives[joint].rotorInertia_kg_m2, bare.robots[0].drives[joint].rotorInertia_kg_m2);
  EXPECT_THROW(placed("coulomb_friction", "leg.*"), InputError);
  EXPECT_THROW(placed("payload", "arm.*"), InputError);
}

TEST(StrangeArm, ThatLacksNothingHasNoMismatch) {
  const GapReport report = analyse(problemOf({}, 2), library(), {});
  EXPECT_EQ(report.verdict, GapReport::Verdict::noMismatch) << toPlainText(report);
  EXPECT_THAT(namedIn(report), testing::IsEmpty());
}

/// Half a step of semi-implicit Euler is not physics that our simulator lacks.
TEST(StrangeArm, ThatAnotherEngineIntegratesCoarselyHasNoMismatch) {
  strange::Arm arm;
  arm.euler_s = 5e-4;
  const GapReport report = analyse(problemOf(arm, 2), library(), {});
  EXPECT_EQ(report.verdict, GapReport::Verdict::noMismatch) << toPlainText(report);
  EXPECT_THAT(namedIn(report), testing::IsEmpty());
  EXPECT_THAT(report.notes, testing::Contains(testing::HasSubstr("within half a step of the scene")));
}

/// Friction is named at its joint, though another engine's coarse steps are beside it.
TEST(StrangeArm, FrictionIsNamedAtItsJointBesideAnothersIntegration) {
  strange::Arm arm;
  arm.euler_s = 5e-4;
  arm.friction[1] = 0.6;
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "command_delay", "rotor_inertia"};
  const GapReport report = analyse(problemOf(arm, 2), library(), options);
  EXPECT_THAT(namedIn(report), testing::ElementsAre("coulomb_friction at arm.joint2")) << toPlainText(report);
}

/// As if commands had been written down two samples before they acted.
void delay(Recording& recording) {
  for (std::size_t i : {1u, 3u, 5u}) {
    std::vector<double>& command = recording.columns[i];
    command.erase(command.begin(), command.begin() + 2);
    command.insert(command.end(), 2, command.back());
  }
}

/// One finding, though three numbers: at most one is asked for.
TEST(StrangeArm, FrictionAtEveryJointIsOneFinding) {
  strange::Arm arm;
  arm.friction = {0.8, 0.5, 0.15};
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "joint_spring", "command_delay"};
  options.maximumEffects = 1;
  const GapReport report = analyse(problemOf(arm, 2), library(), options);
  EXPECT_THAT(namedIn(report),
              testing::UnorderedElementsAre("coulomb_friction at arm.joint1", "coulomb_friction at arm.joint2",
                                            "coulomb_friction at arm.joint3"))
      << toPlainText(report);
  for (const GapReport::Effect& each : report.tried)
    if (each.accepted)
      for (const GapReport::Number& number : each.parameters)
        if (number.name == "torque_nm") {
          const double truth = arm.friction[each.at.back() - '1'];
          EXPECT_NEAR(number.value, truth, 0.05 * truth) << each.at;
        }
}

TEST(StrangeArm, DryAndViscousFrictionAtEveryJointAreTwoFindings) {
  strange::Arm arm;
  arm.friction = {0.8, 0.5, 0.15};
  arm.viscous = {0.6, 0.4, 0.1};
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "joint_spring", "command_delay"};
  const GapReport report = analyse(problemOf(arm, 2), library(), options);
  EXPECT_EQ(namedIn(report).size(), 6U) << toPlainText(report);
}

/// Friction of an arm that sticks where it turns, by torques and motions as arms log them: what the drives give while
/// joints rest is anything that friction carries.
TEST(StrangeArm, FrictionOfJointsThatStickAsTheyTurnIsThatOfTheirMotion) {
  strange::Arm arm;
  arm.friction = {1.6, 1, 0.3};
  GapProblem problem = describedArm(
      0.008, R"("joint1": {"drive": "motion"}, "joint2": {"drive": "motion"}, "joint3": {"drive": "motion"})");
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0, 0.01);
  for (int trial = 0; trial < 3; ++trial) {
    strange::ArmTrial made = strange::SwungArm(arm).run(8, 0.008, 1e-5, random);
    for (std::vector<double>& torques : made.torque)
      for (double& torque : torques) torque += noise(random);
    const Recording recording = recordingOf(made, trial, ".position_rad", made.position, ".torque_nm", made.torque);
    problem.recordings.push_back(resampled(recording, {0, 15}));
  }
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "joint_spring", "payload"};
  const GapReport report = analyse(std::move(problem), library(), options);
  EXPECT_THAT(namedIn(report),
              testing::UnorderedElementsAre("coulomb_friction at arm.joint1", "coulomb_friction at arm.joint2",
                                            "coulomb_friction at arm.joint3"))
      << toPlainText(report);
  for (const GapReport::Effect& each : report.tried)
    if (each.accepted) {
      const double truth = arm.friction[each.at.back() - '1'];
      EXPECT_NEAR(each.parameters.at(0).value, truth, 0.03 * truth) << each.at;
    }
  EXPECT_THAT(report.notes, testing::Contains(testing::HasSubstr("compared while the joint turns")));
}

/// What one joint has another one need not have.
TEST(StrangeArm, FrictionOfOneKindAtOneJointAndOfAnotherAtTheNextIsNotSpread) {
  strange::Arm arm;
  arm.friction[1] = 0.6;
  arm.viscous[0] = 0.9;
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "joint_spring", "command_delay"};
  const GapReport report = analyse(problemOf(arm, 2), library(), options);
  EXPECT_THAT(namedIn(report),
              testing::UnorderedElementsAre("coulomb_friction at arm.joint2", "viscous_friction at arm.joint1"))
      << toPlainText(report);
}

/// One bus feeds all servos: what all joints share is one effect with one number.
TEST(StrangeArm, ADelayThatAllJointsShareIsOneEffect) {
  strange::Arm arm;
  arm.friction[1] = 0.6;
  GapProblem problem = problemOf(arm, 2);
  for (Recording& recording : problem.recordings) delay(recording);
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "command_delay", "rotor_inertia"};
  const GapReport report = analyse(std::move(problem), library(), options);
  EXPECT_THAT(namedIn(report),
              testing::UnorderedElementsAre("command_delay at arm.*", "coulomb_friction at arm.joint2"))
      << toPlainText(report);
  const auto late = std::ranges::find_if(
      report.tried, [](const GapReport::Effect& each) { return each.accepted && each.effect == "command_delay"; });
  ASSERT_NE(late, report.tried.end());
  EXPECT_NEAR(late->parameters.at(0).value, 0.016, 0.001);
}

/// A delay that is longer than half a step stays a delay.
TEST(StrangeArm, AShiftInTimeIsBoundedByHalfAStep) {
  GapProblem problem = problemOf({}, 1, 1e-4);
  delay(problem.recordings[0]);
  const FitProblem fit = makeFitProblem(problem, problem.recordings, library());
  Eigen::VectorXd residuals = residualsOf(fit, givenModel(fit), {});
  const double before = residuals.squaredNorm();
  const Alignment alignment = align(fit, residuals);
  EXPECT_NEAR(std::abs(alignment.shift_s), 0.0005, 1e-12);
  EXPECT_GT(residuals.squaredNorm(), 0.8 * before);
}

/// What a servo forgets need not be simulated to its end: the column is that of the whole replay.
TEST(StrangeArm, AStartThatIsForgottenIsAsIfSimulatedToTheEnd) {
  const GapProblem problem = problemOf({}, 1);
  const FitProblem fit = makeFitProblem(problem, problem.recordings, library());
  const Segment& segment = fit.segments.at(0);
  const Scene scene = fit.sceneOf(fit.given, 0);
  const std::vector<double> none(segment.nuisances.size(), 0);
  const std::vector<double> here = residualsOf(fit, segment, scene, none);
  for (std::size_t i = 0; i < none.size(); ++i) {
    std::vector<double> shift = none;
    shift[i] = 0.1;
    const std::vector<double> whole = residualsOf(fit, segment, scene, shift);
    const std::vector<double> beside = residualsBeside(fit, segment, scene, shift, here);
    ASSERT_EQ(beside.size(), whole.size());
    double most = 0;
    for (std::size_t k = 0; k < whole.size(); ++k) most = std::max(most, std::abs(beside[k] - whole[k]));
    EXPECT_LT(most, 2e-4) << "noise floors, start " << i;
  }
}

}  // namespace arm_of_strangers
}  // namespace btr
