// In which sizes effects are tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/joint_pace.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/screening/screen.h"
#include "core/gap/search/thresholds.h"
#include "core/spec/random.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

std::vector<Values> variantsOf(const Scene& scene, const std::string& effect, const std::string& at) {
  for (const EffectCandidate& candidate : candidatesFor(scene, library(), {}, {effect}, SearchThresholds::Candidates{}))
    if (candidate.at == at) return candidate.variants;
  return {};
}

TEST(CandidateSizes, SoftAndStiffGearsAreTriedWhereverTheSensorsSit) {
  const auto variants = variantsOf(rigScene(R"("hinge": {"p": 6})"), "gear_elasticity", "rig.hinge");
  for (const double sensors : {0.0, 1.0, 2.0, 3.0})
    EXPECT_GE(
        std::ranges::count_if(
            variants, [&](const Values& v) { return v.at("sensors") == sensors && v.at("compliance_rad_nm") >= 0.2; }),
        1)
        << sensors;
}

// A drive that follows torques has a gain of its torque alone (kind 1): too weak is found there, or nowhere.
TEST(CandidateSizes, OfEachKindBothSignsAreTried) {
  for (const char* effect : {"drive_gain", "direction_gain", "sensor_scale"}) {
    const auto variants = variantsOf(rigScene(R"("hinge": {"p": 6})"), effect, "rig.hinge");
    const auto declared = library().make(effect)->parameters();
    for (const double kind : {0.0, 1.0})
      for (const bool up : {true, false})
        EXPECT_TRUE(std::ranges::any_of(variants,
                                        [&](const Values& v) {
                                          return v.at(declared[1].name) == kind &&
                                                 (up ? v.at(declared[0].name) > 0 : v.at(declared[0].name) < 0);
                                        }))
            << effect << " " << declared[1].name << " " << kind << " " << up;
  }
}

// A tenth of what the motor gives, where a size that suits an arm would hold it.
TEST(CandidateSizes, AreInProportionToWhatADriveGivesAtItsPace) {
  GapProblem problem = hingeProblem();
  Recording turning;
  turning.source = "turning.csv";
  turning.channels = {"time_s", "rig.hinge.command_rad", "rig.hinge.position_rad"};
  turning.columns.resize(3);
  Random random(3);
  for (int i = 0; i < 400; ++i) {
    turning.columns[0].push_back(0.005 * i);
    turning.columns[1].push_back(100 * 0.005 * i);
    turning.columns[2].push_back(100 * 0.005 * i + 0.001 * random.normal());
  }
  problem.scene.robots[0].servos.at("hinge").numbers["max_torque_nm"] = 0.3;
  const FitProblem ready = makeFitProblem(problem, {turning}, library());
  const auto parameter = [](const char* effect) { return library().make(effect)->parameters()[0]; };
  const Parameter air = parameter("fluid_drag"), dry = parameter("coulomb_friction");
  EXPECT_NEAR(inProportion(ready, "rig.hinge", air).byDefault * 100 * 100, 0.03, 0.001);
  EXPECT_EQ(inProportion(ready, "rig.hinge", dry).byDefault, dry.byDefault) << "0.03 N·m of 0.3";
  EXPECT_EQ(inProportion(ready, "world", air).byDefault, air.byDefault);
  const Parameter stall = inProportion(ready, "rig.hinge", parameter("torque_speed_limit"));
  EXPECT_DOUBLE_EQ(*stall.neutral, 1 / 0.3) << "a higher stall torque is cut off by the drive's own limit";
  EXPECT_DOUBLE_EQ(stall.minimum, 1 / 0.3);
  EXPECT_DOUBLE_EQ(stall.byDefault, 1 / 0.24);

  // A fit of the drive's limit would leave this one behind, where it limits and yet passes for nothing.
  problem.scene.calibrate.push_back({"robots.rig.servos.hinge.max_torque_nm", 0.2, 0.9});
  const FitProblem fitted = makeFitProblem(problem, {turning}, library());
  const Parameter open = inProportion(fitted, "rig.hinge", parameter("torque_speed_limit"));
  EXPECT_EQ(*open.neutral, 0);
  EXPECT_EQ(open.minimum, 0);
  EXPECT_DOUBLE_EQ(open.byDefault, 1 / 0.24);
}

// A first look at many candidates tried a wave in one number, and all looks tried it in one sign.
TEST(CandidateSizes, AWaveOfAnyPhaseIsSeenWhereManyEffectsAreTried) {
  for (const double phase : {0.0, M_PI / 2, -M_PI / 2, 3.1}) {
    const SimulatorSpec truth{
        {}, {{"torque_ripple", "rig.hinge", {{"amplitude_nm", 0.05}, {"per_turn", 16}, {"phase_rad", phase}}}}};
    const GapProblem recorded = recordedFrom(truth, 0.9, 0, library(), 0.001, 2);
    const FitProblem problem = makeFitProblem(recorded, recorded.recordings, library());
    const Fit fit = fitModel(problem, givenModel(problem), {}, {});
    SearchThresholds::Screening limits;
    limits.many = 1;
    limits.promising = 1;
    const auto candidates = candidatesFor(problem, fit.model, {"torque_ripple", "joint_spring", "force_offset"});
    const std::vector<Screened> seen = screen(problem, fit, linearise(problem, fit), candidates, 1, {}, limits);
    for (const Screened& each : seen) {
      const bool isTheWave = candidates[each.candidate].text() == "torque_ripple at rig.hinge";
      EXPECT_EQ(isTheWave, !each.starts.empty()) << candidates[each.candidate].text() << " " << phase;
      if (!isTheWave || each.starts.empty()) continue;
      EXPECT_GT(each.share, 0.4) << phase;
      const Values& start = each.starts[0].effect;
      EXPECT_NEAR(start.at("per_turn"), 16, 4) << phase;
      EXPECT_LT(std::abs(std::remainder(start.at("phase_rad") - phase, 2 * M_PI)), 1.2);
    }
  }
}

// The rail is pushed by nothing: whether a servo follows its sensor is no question there.
TEST(CandidateSizes, OnlyAServosSensorMayCloseALoop) {
  const GapProblem given = recordedInItsSteps();
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  for (const char* effect : {"position_offset", "sensor_scale", "sensor_lag"}) {
    std::map<std::string, bool> closes;
    for (const EffectCandidate& candidate :
         candidatesFor(problem, givenModel(problem), {effect}, SearchThresholds::Candidates{}))
      closes[candidate.at] =
          std::ranges::any_of(candidate.variants, [](const Values& v) { return v.at("closes_loop") == 1; });
    EXPECT_TRUE(closes.at("rig.hinge")) << effect;
    EXPECT_FALSE(closes.at("rig.rail")) << effect;
  }
}

}  // namespace
}  // namespace btr
