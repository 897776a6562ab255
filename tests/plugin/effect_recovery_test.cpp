// Every effect in whole trials: silent at neutral, finite at its bounds, no energy from what calls itself dissipative,
// and its own parameters found again in a recording that it made.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>

#include "tests/plugin/effect_worlds.h"

namespace btr {
namespace {

using test::Recorded;
using test::Trial;

using test::host;

/// What a local fit from half the size does not find in these worlds, and why.
const std::map<std::string, std::string> notIdentifiable{
    {"torque_ripple.per_turn", "a whole number; its error is full of side minima, it is searched and not fitted"},
    {"backlash.sensors", "a whole number"},
    {"gear_elasticity.sensors", "a whole number"},
    {"drive_dead_band.kind", "a whole number"},
    {"drive_gain.kind", "a whole number"},
    {"drive_lag.inverse_slope_s_nm", "beside the lag it has side minima: the servo swings by itself"},
    {"error_dead_band.kind", "a whole number"},
    {"direction_gain.kind", "a whole number"},
    {"integral_action.settled", "a whole number"},
    {"integral_action.waits", "a whole number"},
    {"position_offset.closes_loop", "a whole number"},
    {"sensor_drift.closes_loop", "a whole number"},
    {"sensor_lag.closes_loop", "a whole number"},
    {"sensor_scale.closes_loop", "a whole number"},
    {"sensor_eccentricity.closes_loop", "a whole number"},
    {"sampled_loop.period_ms", "a whole number"},
    {"stribeck_friction.exponent", "beside the fading speed it has side minima: of six begins two ended in one"},
    {"sampled_loop.damping_stays", "a whole number"},
    {"strength_decline.damping_stays", "a whole number"},
    {"voltage_sag.damping_stays", "a whole number"},
    {"magnus_lift.saturates", "a whole number"},
    // StrangeServo.WithAHardStopOnEitherSideIsSaidToHaveThem finds all of them.
    {"joint_stop.stiffness_nm_rad",
     "two links that hit a stop again and again swing otherwise after the slightest change"},
    {"joint_stop.lower_rad", "the same"},
    {"joint_stop.upper_rad", "the same"},
    {"joint_stop.relaxation_s", "the same"},
    {"payload.y_m", "lies along the only axis that the arm turns about"},
};

/// Where a default is 0 or above what the servo gives anyway, a size that can be told from nothing.
const std::map<std::string, double> sizes{{"joint_spring.rest_rad", 0.5},
                                          {"joint_stop.lower_rad", -0.2},
                                          {"joint_stop.upper_rad", 0.2},
                                          {"joint_stop.relaxation_s", 0.01},
                                          {"torque_ripple.phase_rad", 0.6},
                                          {"payload.x_m", 0.03},
                                          {"payload.z_m", -0.04},
                                          {"anisotropic_rolling_resistance.pile_rad", 0.5},
                                          {"anisotropic_slip.direction_rad", 0.5},
                                          {"coulomb_friction.transition_rad_s", 0.3},
                                          {"load_dependent_friction.transition_rad_s", 0.3},
                                          {"stribeck_friction.transition_rad_s", 0.3},
                                          {"integral_action.clamp_nm", 0.1},
                                          {"command_profile.inverse_speed_s_rad", 0.6},
                                          {"torque_speed_limit.inverse_stall_torque_1_nm", 4}};

/// Where a search begins, as a share of the size: half, but nearer where the error has side minima on the way.
const std::map<std::string, double> begins{{"command_profile.inverse_speed_s_rad", 0.75},
                                           {"joint_stop.stiffness_nm_rad", 0.75}};

class EffectTrials : public testing::TestWithParam<std::string> {
 protected:
  std::string name = GetParam();
  std::shared_ptr<const Effect> effect = host().effect(name);
  std::vector<Parameter> parameters = effect->parameters();

  std::vector<double> record(const std::vector<double>& values) const {
    return test::recordingOf(effect, name, values);
  }

  std::vector<double> defaults() const {
    std::vector<double> values;
    for (const Parameter& p : parameters) {
      const auto size = sizes.find(name + "." + p.name);
      values.push_back(size != sizes.end() ? size->second : p.byDefault);
    }
    return values;
  }
};

TEST_P(EffectTrials, AreTheSameBitsWithTheEffectAtNeutral) {
  std::vector<double> neutral;
  for (const Parameter& p : parameters) neutral.push_back(p.neutral.value_or(p.byDefault));
  for (const Trial& trial : test::trialsFor(effect->place(), name)) {
    const Recorded plain = test::run(trial.scene, trial);
    EXPECT_EQ("", plain.fault);
    EXPECT_EQ(plain.values, test::run(test::withEffect(trial.scene, effect, name, neutral), trial).values);
  }
}

TEST_P(EffectTrials, ChangeLittleNearNeutral) {
  // A millionth of the usual size: what is left is far below what the usual size does.
  std::vector<double> neutral, near;
  for (const Parameter& p : parameters) {
    neutral.push_back(p.neutral.value_or(p.byDefault));
    near.push_back(p.neutral ? *p.neutral + 1e-6 * (p.byDefault - *p.neutral) : p.byDefault);
  }
  if (name == "torque_ripple") neutral[1] = near[1] = parameters[1].byDefault;
  const auto none = record(neutral), little = record(near), usual = record(defaults());
  ASSERT_EQ(none.size(), little.size());
  ASSERT_EQ(none.size(), usual.size());
  double ofLittle = 0, ofUsual = 0;
  for (std::size_t i = 0; i < none.size(); ++i) {
    ofLittle += std::pow(little[i] - none[i], 2);
    ofUsual += std::pow(usual[i] - none[i], 2);
  }
  EXPECT_LT(std::sqrt(ofLittle / ofUsual), 0.02);
}

TEST_P(EffectTrials, StayFiniteAtTheBounds) {
  for (std::size_t corner = 0; corner < std::size_t{1} << parameters.size(); ++corner) {
    std::vector<double> values;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      values.push_back(corner >> i & 1 ? parameters[i].maximum : parameters[i].minimum);
    for (const Trial& trial : test::trialsFor(effect->place(), name)) {
      const Recorded recorded = test::run(test::withEffect(trial.scene, effect, name, values), trial);
      for (const double value : recorded.values) ASSERT_TRUE(std::isfinite(value));
      if (effect->dissipative()) {
        EXPECT_EQ("", recorded.fault);
      }
    }
  }
}

TEST_P(EffectTrials, TakeEnergyFromWhatSwingsAndRollsIfTheySaySo) {
  if (!effect->dissipative()) return;
  for (const Trial& trial : test::trialsFor(effect->place(), name)) {
    if (trial.driven && !trial.scene.robots.empty() && !trial.scene.robots[0].freeBase) continue;
    const Recorded plain = test::run(trial.scene, trial);
    const Recorded recorded = test::run(test::withEffect(trial.scene, effect, name, defaults()), trial);
    EXPECT_EQ("", recorded.fault);
    if (effect->place() == Effect::Place::floor) continue;  // a slope's gravity does work on what creeps further
    EXPECT_LE(recorded.energy.back(), plain.energy.back() + 1e-9);
  }
}

TEST_P(EffectTrials, FindTheirOwnParametersAgain) {
  const std::vector<double> truth = defaults();
  const auto recording = record(truth);
  std::vector<std::size_t> free;
  std::vector<double> scale, values = truth;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (notIdentifiable.contains(name + "." + parameters[i].name)) continue;
    free.push_back(i);
    scale.push_back(std::abs(truth[i] - parameters[i].neutral.value_or(0)));
    ASSERT_GT(scale.back(), 0) << parameters[i].name;
    const auto begin = begins.find(name + "." + parameters[i].name);
    const double share = begin != begins.end() ? begin->second : 0.5;
    values[i] = parameters[i].neutral.value_or(0) + share * (truth[i] - parameters[i].neutral.value_or(0));
  }

  if (free.empty()) GTEST_SKIP() << notIdentifiable.at(name + "." + parameters[0].name);
  // Levenberg and Marquardt's least squares, with central differences, in units of the scales.
  const auto residual = [&](const std::vector<double>& at) {
    const auto simulated = record(at);
    Eigen::VectorXd difference = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(recording.size()), 1e3);
    for (std::size_t i = 0; i < std::min(simulated.size(), recording.size()); ++i)
      difference[static_cast<Eigen::Index>(i)] = simulated[i] - recording[i];
    return difference;
  };
  const auto bounded = [&](std::size_t k, double value) {
    return std::clamp(value, parameters[free[k]].minimum, parameters[free[k]].maximum);
  };
  Eigen::VectorXd error = residual(values);
  const double before = error.norm();
  ASSERT_GT(before, 1e-3) << "half of the effect is not seen";
  double caution = 1e-3;
  for (int round = 0; round < 40 && error.norm() > 1e-7 * before && caution < 1e8; ++round) {
    Eigen::MatrixXd slope(error.size(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t k = 0; k < free.size(); ++k) {
      auto up = values, down = values;
      up[free[k]] = bounded(k, up[free[k]] + 1e-3 * scale[k]);
      down[free[k]] = bounded(k, down[free[k]] - 1e-3 * scale[k]);
      slope.col(static_cast<Eigen::Index>(k)) =
          (residual(up) - residual(down)) / ((up[free[k]] - down[free[k]]) / scale[k]);
    }
    const Eigen::MatrixXd normal = slope.transpose() * slope;
    for (; caution < 1e8; caution *= 8) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() += caution * normal.diagonal();
      const Eigen::VectorXd step = damped.ldlt().solve(-slope.transpose() * error);
      auto next = values;
      for (std::size_t k = 0; k < free.size(); ++k)
        next[free[k]] = bounded(k, next[free[k]] + scale[k] * step[static_cast<Eigen::Index>(k)]);
      const Eigen::VectorXd nextError = residual(next);
      if (!(nextError.norm() < error.norm())) continue;
      values = next;
      error = nextError;
      caution /= 10;
      break;
    }
  }
  for (std::size_t k = 0; k < free.size(); ++k)
    EXPECT_NEAR(truth[free[k]], values[free[k]], 0.03 * scale[k])
        << parameters[free[k]].name << ", error " << before << " -> " << error.norm();
}

INSTANTIATE_TEST_SUITE_P(All, EffectTrials, testing::ValuesIn(test::effectsWithASize()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace btr
