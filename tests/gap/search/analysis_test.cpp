// Gap analysis on recordings that are made here, so that what is missing is known; and its statistics against
// arithmetic.
#include "core/gap/search/analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/score.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_lead.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/screening/candidates.h"
#include "core/spec/random.h"
#include "core/spec/system/cancelled.h"
#include "tests/gap/recorded_hinge.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using testing::HasSubstr;
using Verdict = GapReport::Verdict;

std::vector<std::string> namesOf(const GapReport& report) {
  std::vector<std::string> names;
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted) names.push_back(effect.effect + " at " + effect.at);
  return names;
}

/// What it names, and what it does not tell that from.
std::vector<std::string> readingsOf(const GapReport& report) {
  std::vector<std::string> readings;
  for (const GapReport::Effect& effect : report.tried) {
    if (!effect.accepted) continue;
    readings.push_back(effect.effect);
    for (const GapReport::Rival& rival : effect.rivals) readings.push_back(rival.effect);
  }
  return readings;
}

TEST(Analysis, AHealthySimulatorHasNoMismatch) {
  const GapReport report = analyse(recordedFrom({}), library(), {});
  EXPECT_EQ(report.verdict, Verdict::noMismatch) << report.sentence;
  EXPECT_THAT(namesOf(report), testing::IsEmpty());
  EXPECT_NEAR(report.ladder[0].error, 1, 0.1);
}

TEST(Analysis, AnEffectThatNobodyKnowsIsRefusedBeforeAnythingIsDone) {
  AnalysisOptions options;
  options.effects = {"backlash", "bogus"};
  const std::string refusal = test::refusal([&] { analyse(recordedFrom({}), library(), options); });
  EXPECT_THAT(refusal, HasSubstr("\"bogus\" is not allowed; one of "));
  EXPECT_THAT(refusal, HasSubstr("coulomb_friction"));
}

TEST(Analysis, WrongNumbersAreMerelyCalibrated) {
  const GapReport report = analyse(
      recordedFrom({{{"robots.rig.servos.hinge.p", 7}, {"robots.rig.servos.hinge.d", 0.25}}, {}}), library(), {});
  EXPECT_EQ(report.verdict, Verdict::parametersSuffice) << report.sentence;
  EXPECT_THAT(namesOf(report), testing::IsEmpty());
  ASSERT_EQ(report.calibrated.size(), 2u);
  EXPECT_NEAR(report.calibrated[0].value, 7, 0.05);
  EXPECT_NEAR(report.calibrated[1].value, 0.25, 0.005);
  for (const GapReport::Number& number : report.calibrated) EXPECT_TRUE(number.excited);
}

TEST(Analysis, HiddenDryFrictionIsNamedPlacedAndMeasured) {
  const SimulatorSpec truth{{{"robots.rig.servos.hinge.p", 5.4}},
                            {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.05}}}}};
  const GapReport report = analyse(recordedFrom(truth), library(), {});
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  ASSERT_THAT(namesOf(report), testing::ElementsAre("coulomb_friction at rig.hinge")) << toPlainText(report);
  EXPECT_NEAR(report.tried[0].parameters.at(0).value, 0.05, 0.005);
  EXPECT_LT(report.ladder.back().error, 1.2);
  EXPECT_GT(report.ladder[1].error, 3);
  ASSERT_FALSE(report.located.empty());
  EXPECT_EQ(report.located[0].channel, "rig.hinge.position_rad");
  EXPECT_THAT(report.sentence, HasSubstr("coulomb friction at rig.hinge"));
}

TEST(Analysis, ASpringSoStrongThatTheServoSaturatesIsFound) {
  SimulatorSpec truth;
  truth.effects = {{"joint_spring", "rig.hinge", {{"stiffness_nm_rad", 8}, {"rest_rad", -0.6}}}};
  const GapReport report = analyse(recordedFrom(truth, 1.2), library(), {});
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  ASSERT_THAT(namesOf(report), testing::ElementsAre("joint_spring at rig.hinge")) << report.sentence;
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted) {
      EXPECT_NEAR(effect.parameters[0].value, 8, 0.1) << report.sentence;
    }
}

TEST(Analysis, FrictionThatDiffersByDirectionIsTheSameLawAsDryFrictionWithAConstant) {
  SimulatorSpec truth;
  truth.effects = {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.06}}},
                   {"force_offset", "rig.hinge", {{"torque_nm", 0.03}}}};
  const GapReport report = analyse(recordedFrom(truth), library(), {});
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  // Either as one effect or as two, and then the other reading is listed.
  EXPECT_THAT(readingsOf(report), testing::IsSupersetOf({"coulomb_friction", "force_offset"})) << report.sentence;
  if (namesOf(report).size() == 1) {
    EXPECT_THAT(report.sentence, HasSubstr("together with"));
  }
}

TEST(Analysis, FrictionThatMightDifferByDirectionButDoesNotIsDryAndViscousFriction) {
  SimulatorSpec truth;
  truth.effects = {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.04}}},
                   {"viscous_friction", "rig.hinge", {{"coefficient_nm_s_rad", 0.03}}}};
  AnalysisOptions options;
  options.effects = {"asymmetric_friction", "coulomb_friction", "viscous_friction"};
  GapProblem problem = recordedFrom(truth);
  problem.scene.calibrate.pop_back();  // a servo's d is viscous friction, too
  const GapReport report = analyse(problem, library(), options);
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  EXPECT_THAT(namesOf(report),
              testing::UnorderedElementsAre("coulomb_friction at rig.hinge", "viscous_friction at rig.hinge"))
      << toPlainText(report);
}

TEST(Analysis, TheTeethOfATorqueRippleAreCounted) {
  for (const double teeth : {17.0, 33.0}) {
    const SimulatorSpec truth{
        {}, {{"torque_ripple", "rig.hinge", {{"amplitude_nm", 0.05}, {"per_turn", teeth}, {"phase_rad", 0.7}}}}};
    AnalysisOptions options;
    options.effects = {"torque_ripple", "coulomb_friction"};
    const GapReport report = analyse(recordedFrom(truth), library(), options);
    ASSERT_THAT(namesOf(report), testing::ElementsAre("torque_ripple at rig.hinge")) << toPlainText(report);
    for (const GapReport::Number& number : report.tried[0].parameters) {
      if (number.name == "per_turn") {
        EXPECT_EQ(number.value, teeth) << toPlainText(report);
      } else if (number.name == "amplitude_nm") {
        EXPECT_NEAR(number.value, 0.05, 0.005) << toPlainText(report);
      }
    }
    EXPECT_LT(report.ladder.back().error, 1.1);
  }
}

/// A spring that hardens: τ = −k·q³. No effect of the library.
class HardeningSpring final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"stiffness_nm_rad3", "N·m/rad³", "torque per cubed turn", 0, 20, 1, 0.0}};
  }
  Place place() const override { return Place::joint; }
  double torque(const JointState& joint, std::span<const double> values) const override {
    return -values[0] * joint.position * joint.position * joint.position;
  }
};

// A spring and one wave of a ripple are a cubic over the range that the joint moves in.
TEST(Analysis, ASpringThatHardensIsNoSpringWithARipple) {
  EffectLibrary world = library();
  world.make = [known = world.make](const std::string& name) {
    return name == "hardening_spring" ? std::make_shared<const HardeningSpring>() : known(name);
  };
  const GapProblem problem =
      recordedFrom({{}, {{"hardening_spring", "rig.hinge", {{"stiffness_nm_rad3", 2}}}}}, 0.6, 0, world);
  AnalysisOptions options;
  options.effects = {"joint_spring", "torque_ripple", "coulomb_friction", "viscous_friction"};
  const GapReport report = analyse(problem, library(), options);
  EXPECT_EQ(report.verdict, GapReport::Verdict::unexplained) << report.sentence;
  EXPECT_GT(report.ladder.front().error, 5) << "there was something to explain";
}

Extent motionIn(const GapProblem& recorded) {
  Extent position;
  for (const Recording& recording : recorded.recordings) position.add(recording.columns[2]);
  return position;
}

TEST(EffectCandidates, PeriodsAreCountedWhereTheMotionPassesTwoOfThem) {
  const GapProblem recorded = recordedInItsSteps();
  const FitProblem problem = makeFitProblem(recorded, recorded.recordings, library());
  const auto [low, high] = motionIn(recorded);
  const auto ripple = [&](const std::string& at) { return parametersAt(problem, "torque_ripple", at)[1]; };
  EXPECT_EQ(ripple("rig.hinge").name, "per_turn");
  EXPECT_EQ(ripple("rig.hinge").minimum, std::ceil(4 * M_PI / (high - low)));
  for (const EffectCandidate& candidate : candidatesFor(problem, givenModel(problem), {"torque_ripple"})) {
    EXPECT_EQ(candidate.at, "rig.hinge") << "the rail was not measured";
    for (const Values& variant : candidate.variants) EXPECT_GE(variant.at("per_turn"), ripple("rig.hinge").minimum);
  }
}

TEST(EffectCandidates, EndsOfAFreeRangeAreLookedForWithinTheMotion) {
  const GapProblem recorded = recordedInItsSteps();
  const FitProblem problem = makeFitProblem(recorded, recorded.recordings, library());
  const auto [low, high] = motionIn(recorded);
  const auto candidates = candidatesFor(problem, givenModel(problem), {"joint_stop"});
  ASSERT_EQ(candidates.size(), 1u) << "the rail was not measured";
  EXPECT_EQ(candidates[0].at, "rig.hinge");
  for (const Values& variant : candidates[0].variants) {
    EXPECT_GT(variant.at("lower_rad"), low);
    EXPECT_LT(variant.at("lower_rad"), variant.at("upper_rad"));
    EXPECT_LT(variant.at("upper_rad"), high);
  }
}

TEST(Analysis, ADelayIsNotTakenForFriction) {
  const SimulatorSpec truth{{}, {{"command_delay", "rig.hinge", {{"delay_s", 0.02}}}}};
  const GapReport report = analyse(recordedFrom(truth), library(), {});
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  ASSERT_THAT(namesOf(report), testing::ElementsAre("command_delay at rig.hinge")) << toPlainText(report);
  EXPECT_NEAR(report.tried[0].parameters.at(0).value, 0.02, 0.002);
}

// What made the recordings may have read them elsewhere within a step.
TEST(Analysis, ADelayOfLessThanHalfAStepIsNoEffect) {
  const SimulatorSpec truth{{}, {{"command_delay", "rig.hinge", {{"delay_s", 0.0004}}}}};
  AnalysisOptions options;
  options.effects = {"command_delay", "sensor_lag"};
  EXPECT_THAT(namesOf(analyse(recordedFrom(truth), library(), options)), testing::IsEmpty());
}

TEST(Analysis, ASensorThatIsOffFromTheFirstSampleOnIsExplainedDownToTheNoise) {
  const SimulatorSpec truth{{}, {{"position_offset", "rig.hinge", {{"offset_rad", 0.1}}}}};
  AnalysisOptions options;
  options.effects = {"position_offset"};
  const GapReport report = analyse(recordedFrom(truth), library(), options);
  ASSERT_THAT(namesOf(report), testing::ElementsAre("position_offset at rig.hinge")) << toPlainText(report);
  EXPECT_NEAR(report.tried[0].parameters.at(0).value, 0.1, 0.001);
  EXPECT_LT(report.ladder.back().error, 1.1);
}

TEST(Analysis, AServoThatStillSwingsTooSlowlyToBeSeenWhenTheRecordingBeginsIsNoMismatch) {
  const SimulatorSpec truth{{}, {{"rotor_inertia", "rig.hinge", {{"inertia_kg_m2", 1}}}}};
  GapProblem problem = recordedFrom(truth, 0.6, 0.02);
  problem.simulator = truth;
  const GapReport report = analyse(problem, library(), {});
  EXPECT_EQ(report.verdict, Verdict::noMismatch) << report.sentence;
  EXPECT_NEAR(report.ladder[0].error, 1, 0.1);
}

TEST(Analysis, ARecordingInWhichNothingMovesTellsNothing) {
  const GapReport report = analyse(recordedFrom({}, 1e-4), library(), {});
  EXPECT_EQ(report.verdict, Verdict::notExcited) << report.sentence;
  EXPECT_THAT(namesOf(report), testing::IsEmpty());
}

// About the axis of an only joint a gravity that leans and a sensor that is off are the same law, whatever else the
// leaning brings along.
TEST(Analysis, AnOffSensorOfAnOnlyJointIsNotToldFromGravityThatLeansAboutItsAxis) {
  const GapReport report =
      analyse(recordedFrom({{{"robots.rig.servos.hinge.p", 7}, {"robots.rig.servos.hinge.d", 0.25}},
                            {{"gravity_tilt", "world", {{"about_y_rad", 0.18}}}}}),
              library(), {});
  ASSERT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  ASSERT_EQ(namesOf(report).size(), 1u) << report.sentence;
  EXPECT_THAT(readingsOf(report), testing::IsSupersetOf({"gravity_tilt", "position_offset"})) << report.sentence;
}

// Something heavy beside the arm makes its gravity larger and turns it; its inertia looks like a weaker servo.
TEST(Analysis, AWeightBesideAnOnlyArmIsNotToldFromGravityThatLeans) {
  AnalysisOptions options;
  options.effects = {"gravity_tilt", "payload", "coulomb_friction"};
  const GapReport report =
      analyse(recordedFrom({{}, {{"payload", "rig.bob", {{"mass_kg", 0.09}, {"x_m", 0.11}, {"z_m", 0.08}}}}}),
              library(), options);
  ASSERT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  ASSERT_EQ(namesOf(report).size(), 1u) << report.sentence;
  EXPECT_THAT(readingsOf(report), testing::IsSupersetOf({"gravity_tilt", "payload"})) << toPlainText(report);
}

TEST(Analysis, AJointThatStandsStillThoughItIsToldToMoveTellsThatItIsHeld) {
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "command_delay", "force_offset"};
  const SimulatorSpec truth{{}, {{"coulomb_friction", "rig.hinge", {{"torque_nm", 1.9}}}}};
  const GapReport report = analyse(recordedFrom(truth, 0.25), library(), options);
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  EXPECT_THAT(namesOf(report), testing::ElementsAre("coulomb_friction at rig.hinge")) << toPlainText(report);
  // Whatever holds it would do.
  EXPECT_THAT(report.sentence, HasSubstr("Not identifiable from these recordings"));
  EXPECT_THAT(report.sentence, HasSubstr("how large coulomb friction at rig.hinge is"));
}

TEST(Analysis, WhatHoldsAJointMayBeAnythingThatIsLarge) {
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "rotor_inertia", "command_delay", "force_offset"};
  const SimulatorSpec truth{{}, {{"viscous_friction", "rig.hinge", {{"coefficient_nm_s_rad", 900}}}}};
  const GapReport report = analyse(recordedFrom(truth, 0.25, 0, library(), 0.0001, 4), library(), options);
  EXPECT_EQ(report.verdict, Verdict::missingPhysics) << report.sentence;
  EXPECT_EQ(namesOf(report).size(), 1u) << toPlainText(report);
  // Not the largest rotor: a load of 2 N·m turns 200 kg·m² by 5 mrad in the first second, ten noise floors.
  EXPECT_THAT(readingsOf(report), testing::UnorderedElementsAre("coulomb_friction", "viscous_friction"))
      << toPlainText(report);
}

TEST(Analysis, TheNumberOfWorkersChangesNothing) {
  const GapProblem problem =
      recordedFrom({{}, {{"viscous_friction", "rig.hinge", {{"coefficient_nm_s_rad", 0.05}}}}}, 0.3);
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "command_delay", "force_offset"};
  GapReport one = analyse(problem, library(), options);
  options.jobs = 3;
  GapReport three = analyse(problem, library(), options);
  one.seconds = three.seconds = 0;
  EXPECT_EQ(toJsonText(one), toJsonText(three));
}

TEST(Analysis, CanBeCancelledAtAnyStage) {
  // By stages and not by calls: a stage is told again ten times a second, so their number depends on the machine.
  const GapProblem problem = recordedFrom({});
  std::vector<std::string> stages;
  double last = 0;
  analyse(problem, library(), {}, [&](const std::string& stage, double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    if (std::find(stages.begin(), stages.end(), stage) == stages.end()) stages.push_back(stage);
    last = share;
    return true;
  });
  ASSERT_GT(stages.size(), 3u);
  EXPECT_EQ(last, 1);
  for (const std::string& cancelledIn : stages) {
    if (cancelledIn == stages.back()) continue;  // says that it is done
    std::string at;
    const auto progress = [&](const std::string& stage, double) {
      at = stage;
      return stage != cancelledIn;
    };
    EXPECT_THROW(analyse(problem, library(), {}, progress), Cancelled) << cancelledIn;
    EXPECT_EQ(at, cancelledIn);
  }
}

TEST(Analysis, ReportsWhatWasFoundWhereItIsCutShort) {
  const GapProblem problem = recordedFrom({{}, {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.08}}}}});
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "command_delay"};
  options.isEnough = [] { return true; };
  const GapReport atOnce = analyse(problem, library(), options);
  EXPECT_THAT(namesOf(atOnce), testing::IsEmpty());
  EXPECT_THAT(atOnce.sentence, HasSubstr("cut short")) << "nothing is said to be missing, or not to be";
  EXPECT_THAT(atOnce.sentence, HasSubstr("No effect that was looked at until then"));
  EXPECT_THAT(leadOf(atOnce).headline, HasSubstr("Cut short"));

  // From the first look at rivals on.
  bool isEnough = false;
  options.isEnough = [&] { return isEnough; };
  const GapReport later = analyse(problem, library(), options, [&](const std::string& stage, double) {
    isEnough = isEnough || stage.find("rivals") != std::string::npos || stage == "measuring what has no name";
    return true;
  });
  ASSERT_THAT(namesOf(later), testing::ElementsAre("coulomb_friction at rig.hinge")) << toPlainText(later);
  const auto found = std::ranges::find_if(later.tried, &GapReport::Effect::accepted);
  EXPECT_NEAR(found->parameters[0].value, 0.08, 0.004);
  EXPECT_LT(found->pValue, 0.01);
}

TEST(Analysis, ALongFitSaysHowFarItIs) {
  std::vector<double> shares;
  analyse(recordedFrom({{{"robots.rig.servos.hinge.p", 7}, {"robots.rig.servos.hinge.d", 0.25}}, {}}), library(), {},
          [&](const std::string& stage, double share) {
            if (stage == "calibrating") shares.push_back(share);
            return true;
          });
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
  EXPECT_GT(shares.size(), 6u) << "more than one for each of the fits";
}

TEST(Analysis, WithoutRecordingsItSaysWhatItNeeds) {
  GapProblem problem = recordedFrom({});
  problem.recordings.clear();
  EXPECT_THROW(analyse(problem, library(), {}), InputError);
}

TEST(Analysis, RejectedEffectsHaveNoIntervalAndSayWhatTheyAre) {
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "stribeck_friction", "viscous_friction"};
  const GapReport report =
      analyse(recordedFrom({{}, {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.05}}}}}), library(), options);
  int rejected = 0;
  for (const GapReport::Effect& effect : report.tried) {
    EXPECT_FALSE(effect.qValue < effect.pValue) << effect.effect;
    if (effect.accepted) {
      EXPECT_LE(effect.qValue, 0.05);
      continue;
    }
    for (const GapReport::Number& number : effect.parameters) {
      ++rejected;
      const std::vector<Parameter> declared = library().make(effect.effect)->parameters();
      const Parameter& p = *find(declared, number.name);
      EXPECT_FALSE(number.ci95.known());
      EXPECT_TRUE(number.excited) << "what is not felt is not fitted";
      if (number.value > p.maximum - 1e-4 * (p.maximum - p.minimum)) {
        EXPECT_TRUE(number.atBound) << effect.effect;
      }
    }
  }
  EXPECT_GT(rejected, 2);
}

TEST(Analysis, NothingIsAdoptedFromRecordingsThatTellNothing) {
  GapProblem problem = recordedFrom({}, 1e-4);
  problem.simulator.values = {{"robots.rig.servos.hinge.p", 6.5}};
  const GapReport report = analyse(problem, library(), {});
  EXPECT_EQ(report.verdict, Verdict::notExcited) << report.sentence;
  EXPECT_EQ(report.after, problem.simulator);
}

TEST(Analysis, AFittedFileIsNoHeldOutOne) {
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  AnalysisRequest request;
  request.scene = folder.write("scene.json", R"({"format": "uchilsim-scene-1", "robots": [
    {"name": "rig", "model": "rig.urdf", "base": "fixed", "servos": {"hinge": {"p": 6}}}]})");
  const std::string text = "time_s,rig.hinge.command_rad,rig.hinge.position_rad\n0,0,0\n0.1,0.1,0\n0.2,0.2,0.1\n";
  request.recordings = {folder.write("a.csv", text)};
  request.heldOut = {folder.write("copy.csv", text)};
  const std::string message = test::refusal([&] { loadProblem(request); });
  EXPECT_THAT(message, HasSubstr("copy.csv (held out)"));
  EXPECT_THAT(message, HasSubstr("a.csv, which is fitted"));
  request.heldOut = {folder.write("other.csv", text + "0.3,0.3,0.2\n")};
  EXPECT_EQ(test::refusal([&] { loadProblem(request); }), "accepted");
}

TEST(EffectCandidates, EveryEffectIsTriedAtEveryPlaceThatItFits) {
  const GapProblem problem = recordedFrom({});
  const FitProblem fit = makeFitProblem(problem, problem.recordings, library(), 0);
  const auto candidates =
      candidatesFor(fit, givenModel(fit), {"coulomb_friction", "payload", "gravity_tilt", "ground_slope"});
  std::vector<std::string> texts;
  for (const EffectCandidate& candidate : candidates) texts.push_back(candidate.text());
  // No floor, so no slope; the wall never moves.
  EXPECT_THAT(texts,
              testing::UnorderedElementsAre("coulomb_friction at rig.hinge", "coulomb_friction at rig.rail",
                                            "payload at rig.bob", "payload at rig.cart", "gravity_tilt at world"));
}

TEST(PairedTest, IsStudentsPairedTest) {
  // Differences of logarithms: with the resolution of 0.02 added, ln 2 ± 0: by construction all blocks fall by half.
  std::vector<double> without, with;
  for (const double x : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    without.push_back(x);
    with.push_back((x + 0.02) / 2 * (1 + 0.01 * (x - 3.5)) - 0.02);
  }
  const PairedTest comparison = compare(without, with);
  double mean = 0, square = 0;
  std::vector<double> d;
  for (std::size_t i = 0; i < with.size(); ++i) d.push_back(std::log((without[i] + 0.02) / (with[i] + 0.02)));
  for (const double x : d) mean += x / 6;
  for (const double x : d) square += (x - mean) * (x - mean);
  EXPECT_NEAR(comparison.t, mean / std::sqrt(square / 5 / 6), 1e-9);
  EXPECT_LT(comparison.pValue, 1e-4);
  EXPECT_NEAR(comparison.gain, 1 - (with[0] + with[1] + with[2] + with[3] + with[4] + with[5]) / 21, 1e-12);
}

TEST(PairedTest, OfEqualModelsDecidesNothing) {
  Random random(3);
  int decided = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    std::vector<double> a, b;
    for (int block = 0; block < 40; ++block) {
      a.push_back(1 + 0.2 * random.normal());
      b.push_back(1 + 0.2 * random.normal());
    }
    decided += compare(a, b).pValue < 0.01;
  }
  // The doubled p-value keeps its promise: at most 1 in 100, within three standard errors of a count of 400.
  EXPECT_LE(decided, 4 + 6);
}

}  // namespace
}  // namespace btr
