// Cases of earlier proofs that the analysis got wrong once, and that a scene made by hand does not show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/starts_anew.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/prove/open_case.h"

namespace btr::prove {
namespace {

/// What the analysis makes of such a case, from `effects` alone.
GapReport analysedHiding(const std::vector<PlacedEffect>& hidden, const CaseRequest& request,
                         const std::vector<std::string>& effects) {
  const Plugins plugins;
  const BlindCase blind = caseHiding(hidden, request, plugins);
  AnalysisOptions options;
  options.effects = effects;
  return analyse(problemOf(blind, plugins), {plugins.library.make, plugins.library.names}, options);
}

// A weight beside a small arm, and a servo of which nothing is trusted: gravity that leans and a stronger servo are the
// same law. A fit of the weight that began far away ended in a side minimum, so that only gravity was named.
TEST(Mended, AWeightBesideAnArmIsNotToldFromGravityThatLeans) {
  const PlacedEffect payload{
      "payload", "rig.arm", {{"mass_kg", 0.023162}, {"x_m", 0.06206}, {"y_m", 0.086374}, {"z_m", 0.032537}}};
  const GapReport report =
      analysedHiding({payload}, {20261150, 1, "ode", "pendulum", ""}, {"gravity_tilt", "payload", "position_offset"});
  EXPECT_THAT(namedIn(report), testing::AnyOf(testing::ElementsAre("gravity_tilt", "or payload"),
                                              testing::ElementsAre("payload", "or gravity_tilt")))
      << toPlainText(report);
}

// Wind over a ball that rolls until it stops: its fit ended in a rough valley of wind and rolling resistance, 5 % above
// what the true numbers leave, and a slope, which left less than that, was named alone.
TEST(Mended, WindOverARollingBallIsNotCalledASlopeAlone) {
  const PlacedEffect wind{"constant_wind", "world", {{"x_m_s", 3.35076}, {"y_m_s", -3.70085}}};
  const GapReport report =
      analysedHiding({wind}, {20261155, 24, "ode", "carpet", ""}, {"constant_wind", "ground_slope"});
  EXPECT_THAT(namedIn(report),
              testing::AnyOf(testing::Contains("constant_wind"), testing::Contains("or constant_wind")))
      << toPlainText(report);
}

// A ball that bounces, followed from its start with numbers that are right: a fit of the start ended where the second
// trial's upward velocity was five standard errors off, and half of its way was missed.
TEST(Mended, ABallsStartIsFoundAcrossItsBounces) {
  const Plugins plugins;
  const PlacedEffect drag{"air_drag", "ball", {{"drag_number", 0.315179}}};
  const BlindCase blind = caseHiding({drag}, {20261150, 29, "ode", "flight", ""}, plugins);
  const TemporaryFolder folder;
  writeCase(blind, plugins.library, folder.file("."));
  writeFresh(blind, plugins.library, folder.file("fresh"));
  GapProblem given;
  given.scene = loadScene(folder.file("scene.json"));
  given.scene.step_s = 0.00025;
  given.simulator = {{{"floor.restitution", 0.4138971744686201}},
                     {{"air_drag", "ball", {{"drag_number", 0.31269444864451135}}}}};
  for (const char* trial : {"fresh/trial_1.csv", "fresh/trial_2.csv"})
    given.recordings.push_back(loadRecording(folder.file(trial)));
  const FitProblem problem = makeFitProblem(given, given.recordings, {plugins.library.make, plugins.library.names}, 0);
  const Fit once = fitModel(problem, {}, {}, {.iterations = 40, .startsOnly = true});
  const Fit anew = withStartsAnew(problem, once);
  EXPECT_LE(anew.cost, once.cost);
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    FitProblem one = problem;
    one.segments = {problem.segments[s]};
    const Eigen::VectorXd residuals = residualsOf(one, anew.model, {anew.shifts[s]});
    EXPECT_LT(residuals.squaredNorm() / static_cast<double>(residuals.size()), 1.1) << "trial " << s + 1;
  }
}

// A servo that hunts in its play leaves its path where the play begins in the middle; it had rested on the flank that
// holds the arm before the recording began. (Its numbers were then off by 2 % with 2.5 noise floors left, after half an
// hour.)
TEST(Mended, AServoInItsPlayIsFollowedFromTheFlankThatItRestedOn) {
  const Plugins plugins;
  const PlacedEffect play{"backlash", "rig.shoulder", {{"free_speed_rad_s_nm", 3.112754}, {"width_rad", 0.0888316}}};
  const BlindCase blind = caseHiding({play}, {20261150, 14, "ode", "pendulum", ""}, plugins);
  GapProblem given = problemOf(blind, plugins);
  given.scene.step_s = 0.000125;
  given.simulator = blind.simulator;
  const FitProblem problem = makeFitProblem(given, given.recordings, {plugins.library.make, plugins.library.names}, 0);
  const Fit fit = fitModel(problem, {}, {}, {.iterations = 20, .startsOnly = true});
  const Eigen::VectorXd residuals = residualsOf(problem, fit.model, fit.shifts);
  EXPECT_LT(residuals.squaredNorm() / static_cast<double>(residuals.size()), 1.15);
}

// Dry friction that stops a weak servo again and again: a fit of it alone ended in a side minimum, and friction that is
// larger at rest, with two numbers more, was named.
TEST(Mended, DryFrictionIsFoundFromTheRicherFrictionThatContainsIt) {
  const PlacedEffect friction{"coulomb_friction", "rig.shoulder", {{"torque_nm", 0.054504}}};
  const GapReport report =
      analysedHiding({friction}, {20261148, 12, "ode", "pendulum", ""}, {"stribeck_friction", "coulomb_friction"});
  EXPECT_THAT(namedIn(report), testing::ElementsAre("coulomb_friction")) << toPlainText(report);
}

// Nearly as much dry friction as the servo is strong. From friction that differs by direction, both directions the
// same, the way to it was never gone: a hundredth of what was taken away does nothing. Where the whole of it is
// offered, rounding (another library of mathematical functions is enough) decides whether a fit gets there, so that its
// size is looked for.
TEST(Mended, DryFrictionTakesThePlaceOfFrictionByDirection) {
  const PlacedEffect friction{"coulomb_friction", "rig.shoulder", {{"torque_nm", 0.852713}}};
  const GapReport report =
      analysedHiding({friction}, {20261159, 88, "ode", "pendulum", ""}, {"asymmetric_friction", "coulomb_friction"});
  EXPECT_THAT(namedIn(report), testing::ElementsAre("coulomb_friction")) << toPlainText(report);
}

// Sensors of counts alone: a weight, with four numbers, took 3 % off what an offset had left below the noise floor, and
// was named without a rival.
TEST(Mended, WhatTakesALittleOfTheNoiseDoesNotRefuteTheSimpler) {
  const PlacedEffect offset{"position_offset", "rig.shoulder", {{"offset_rad", -0.206839}}};
  const GapReport report =
      analysedHiding({offset}, {20261159, 85, "ode", "pendulum", ""}, {"payload", "position_offset"});
  EXPECT_THAT(namedIn(report), testing::ElementsAre("position_offset", "or payload")) << toPlainText(report);
}

// Three hundred times as much slip as is usual: looked at in usual sizes, the recordings seemed not to feel it.
TEST(Mended, SlipIsLookedForInSizesThatAreFelt) {
  const PlacedEffect slip{"slip", "floor", {{"slip_m_s_n", 5.959071}}};
  const GapReport report = analysedHiding({slip}, {20261159, 34, "ode", "carpet", ""}, {"slip", "ground_slope"});
  EXPECT_THAT(namedIn(report), testing::ElementsAre("slip")) << toPlainText(report);
}

// Nothing but numbers is wrong, and calibration stopped where a servo's largest torque was not felt, 2.1 noise floors
// off. Whatever effect was added, the fit went on from there and found the torque; an offset of 4·10⁻⁵ rad was named.
TEST(Mended, WhatOnlyShowsTheCalibrationItsWayIsNoEffect) {
  const Plugins plugins;
  const BlindCase blind = drawCase({20261162, 62, "ode", "pendulum", ""}, plugins.library);
  ASSERT_TRUE(blind.simulator.effects.empty());
  AnalysisOptions options;
  options.effects = {"position_offset", "backlash"};
  const GapReport report = analyse(problemOf(blind, plugins), {plugins.library.make, plugins.library.names}, options);
  EXPECT_EQ(report.verdict, GapReport::Verdict::parametersSuffice) << toPlainText(report);
  for (const GapReport::Number& number : report.calibrated)
    EXPECT_NEAR(number.value / blind.simulator.values.at(number.name), 1, 1e-3) << number.name;
}

// A joint in honey: what it does follows from the servo's gain over the friction, and both had gone half as far again
// as they are, along a valley without a slope. What recordings do not tell is as given, and here that is the truth.
TEST(Mended, NumbersThatRecordingsDoNotTellAreAsGiven) {
  constexpr double coefficient = 135.265940;
  const PlacedEffect friction{"viscous_friction", "rig.shoulder", {{"coefficient_nm_s_rad", coefficient}}};
  const GapReport report = analysedHiding({friction}, {20261165, 59, "ode", "pendulum", ""}, {"viscous_friction"});
  ASSERT_EQ(report.calibrated.size(), 3u);
  for (const GapReport::Number& number : report.calibrated) {
    EXPECT_FALSE(number.excited) << number.name;
    EXPECT_EQ(number.value, number.before) << number.name;
  }
  ASSERT_THAT(namedIn(report), testing::ElementsAre("viscous_friction")) << toPlainText(report);
  const auto found = std::ranges::find_if(report.tried, &GapReport::Effect::accepted);
  EXPECT_NEAR(found->parameters.at(0).value / coefficient, 1, 0.05);
}

// The same joint whose friction the scene knows, less of it: of gain and friction one must follow the other, which
// stays as given. The largest torque, which the simulator does not feel, is in the report beside them.
TEST(Mended, OfTwoNumbersThatAreToldTogetherOneIsAsGiven) {
  const Plugins plugins;
  const std::string servo = "robots.rig.servos.shoulder.",
                    friction = "robots.rig.joints.shoulder.viscous_friction_nm_s_rad";
  constexpr double coefficient = 135.265940;
  const PlacedEffect hidden{"viscous_friction", "rig.shoulder", {{"coefficient_nm_s_rad", coefficient}}};
  const BlindCase blind = caseHiding({hidden}, {20261165, 59, "ode", "pendulum", ""}, plugins);
  GapProblem given = problemOf(blind, plugins);
  given.simulator.values[friction] = 100;
  given.scene.calibrate.push_back({friction, 10, 1000});
  AnalysisOptions options;
  options.effects = {"backlash"};
  const GapReport report = analyse(given, {plugins.library.make, plugins.library.names}, options);
  EXPECT_EQ(report.verdict, GapReport::Verdict::parametersSuffice) << toPlainText(report);
  ASSERT_EQ(report.calibrated.size(), 4u) << toPlainText(report);
  std::map<std::string, GapReport::Number> numbers;
  for (const GapReport::Number& number : report.calibrated) numbers[number.name] = number;
  const auto isAsGiven = [&](const std::string& name) { return numbers.at(name).value == numbers.at(name).before; };
  EXPECT_TRUE(isAsGiven(servo + "max_torque_nm")) << toPlainText(report);
  EXPECT_NE(isAsGiven(servo + "p"), isAsGiven(friction)) << toPlainText(report);
  const double ratio = numbers.at(friction).value / numbers.at(servo + "p").value;
  EXPECT_NEAR(ratio / (coefficient / blind.simulator.values.at(servo + "p")), 1, 0.05) << toPlainText(report);
}

// A ripple that holds its joint hard (14 noise floors): fits over whole trials ended with 28 waves in a turn, or with
// 27 and numbers that left 1.3 noise floors.
TEST(Mended, ARippleThatCatchesItsJointHasItsWaves) {
  const Plugins plugins;
  constexpr double amplitude = 0.245167121, waves = 27, phase = -0.065472638;
  const PlacedEffect hidden{
      "torque_ripple", "rig.shoulder", {{"amplitude_nm", amplitude}, {"per_turn", waves}, {"phase_rad", phase}}};
  const BlindCase blind = caseHiding({hidden}, {20261165, 204, "ode", "pendulum", ""}, plugins);
  AnalysisOptions options;
  options.effects = {"torque_ripple"};
  const GapReport report = analyse(problemOf(blind, plugins), {plugins.library.make, plugins.library.names}, options);
  ASSERT_THAT(namedIn(report), testing::ElementsAre("torque_ripple")) << toPlainText(report);
  const auto found = std::ranges::find_if(report.tried, &GapReport::Effect::accepted);
  std::map<std::string, double> numbers;
  for (const GapReport::Number& number : found->parameters) numbers[number.name] = number.value;
  EXPECT_EQ(numbers.at("per_turn"), waves);
  EXPECT_NEAR(numbers.at("amplitude_nm") / amplitude, 1, 0.01);
  EXPECT_NEAR(numbers.at("phase_rad"), phase, 0.02);
  EXPECT_LT(report.ladder.back().error, 1.1) << toPlainText(report);
}

// A weight and a rotor: a weight of any place beside a servo of any strength took up 96 % alone, with 4.5 noise floors
// left, and from the numbers that it bent no fit found the rotor beside it.
TEST(Mended, OneEffectThatLeavesMuchGivesWayToTwo) {
  const PlacedEffect payload{
      "payload", "rig.arm", {{"mass_kg", 0.106836}, {"x_m", -0.079144}, {"y_m", -0.033529}, {"z_m", -0.031255}}};
  const PlacedEffect rotor{"rotor_inertia", "rig.shoulder", {{"inertia_kg_m2", 0.0514}}};
  const GapReport report =
      analysedHiding({payload, rotor}, {20261162, 79, "ode", "pendulum", ""}, {"payload", "rotor_inertia"});
  EXPECT_THAT(namedIn(report), testing::UnorderedElementsAre("payload", "rotor_inertia")) << toPlainText(report);
  EXPECT_LT(report.ladder.back().error, 1.1) << toPlainText(report);
}

// A constant torque beside gravity that leans; a rotor does instead of the latter with another servo. Which of the two
// it is, the recordings do not tell, so the servo's numbers are known as far as both agree.
TEST(Mended, NumbersThatRivalsDisagreeOnAreKnownAmongThem) {
  const Plugins plugins;
  const PlacedEffect offset{"force_offset", "rig.shoulder", {{"torque_nm", 0.010412}}};
  const PlacedEffect tilt{"gravity_tilt", "world", {{"about_x_rad", -0.346304}, {"about_y_rad", 0}}};
  const BlindCase blind = caseHiding({offset, tilt}, {20261162, 45, "ode", "pendulum", ""}, plugins);
  AnalysisOptions options;
  options.effects = {"force_offset", "gravity_tilt", "rotor_inertia"};
  const GapReport report = analyse(problemOf(blind, plugins), {plugins.library.make, plugins.library.names}, options);
  EXPECT_THAT(namedIn(report), testing::IsSupersetOf({"force_offset", "rotor_inertia", "or gravity_tilt"}));
  for (const GapReport::Number& number : report.calibrated) {
    const double truth = blind.simulator.values.at(number.name);
    ASSERT_TRUE(number.amongRivals.known()) << number.name;
    EXPECT_LE(number.amongRivals.low, truth) << number.name;
    EXPECT_GE(number.amongRivals.high, truth) << number.name;
    EXPECT_LE(number.amongRivals.low, number.ci95.low) << number.name;
    EXPECT_GE(number.amongRivals.high, number.ci95.high) << number.name;
  }
}

// A sensor that lags beside a constant torque: a weight is found first, and an offset, which is simpler, takes its
// place. What stood beside the lag was then looked for a second time (an XL330's analysis, with three effects, did so
// up to six times).
TEST(Mended, RivalsBesideTheSameEffectsAreLookedForOnce) {
  const Plugins plugins;
  // Drawn from the effects that there were when it was found.
  Hideable then = plugins.library;
  std::erase_if(then.names, [](const std::string& name) {
    return std::set<std::string>{"bristle_friction",     "command_filter",   "command_profile", "direction_gain",
                                 "drive_dead_band",      "drive_lag",        "error_dead_band", "fluid_drag",
                                 "gravity_compensation", "integral_action",  "measured_law",    "rate_feedforward",
                                 "restitution_by_speed", "sampled_loop",     "sensor_drift",    "sensor_eccentricity",
                                 "sensor_scale",         "strength_decline", "viscous_drag",    "rate_filter",
                                 "thinning_friction",    "floor_place",      "drive_gain",      "joint_stop"}
        .contains(name);
  });
  const BlindCase blind = drawCase({20261171, 18, "ode", "pendulum", "two"}, then);
  AnalysisOptions options;
  options.effects = {"payload", "position_offset", "sensor_lag"};
  int asked = 0;
  std::string last;
  const auto count = [&](const std::string& stage, double) {
    if (stage != last && stage == "fitting candidates, rivals") ++asked;
    last = stage;
    return true;
  };
  const GapReport report =
      analyse(problemOf(blind, plugins), {plugins.library.make, plugins.library.names}, options, count);
  const auto replaced = [](const GapReport::Step& step) { return step.what.find("→") != std::string::npos; };
  ASSERT_EQ(std::ranges::count_if(report.ladder, replaced), 1) << toPlainText(report);
  EXPECT_THAT(namedIn(report), testing::UnorderedElementsAre("position_offset", "or payload", "sensor_lag"));
  // Beside the weight, beside the lag, beside the offset.
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace btr::prove
