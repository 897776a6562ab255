// What noise of recorded inputs makes of what is compared: of positions that a joint follows in the torque that this
// takes, of torques that drive it in its positions.
#include "core/gap/fit/input_noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "core/gap/fit/alignment.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/recordings/resample.h"
#include "core/spec/random.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace input_noise {

using testing::Contains;
using testing::HasSubstr;

constexpr double inertia = 0.5 * 0.2 * 0.2 + 1e-4, weight = 0.5 * 9.81 * 0.2;
constexpr double period_s = 0.002, positionNoise = 5e-4, torqueNoise = 2e-3;

/// A swing of three sines and the torque that it takes, I·q̈ + m·g·l·sin q, so much later than its row says, each with
/// white noise.
Recording followedSwing(std::uint64_t number, double later_s) {
  Random random = Random::forPurpose(11, "swing", number);
  Recording recording;
  recording.source = "swing_" + std::to_string(number) + ".csv";
  recording.channels = {"time_s", "rig.hinge.position_rad", "rig.hinge.torque_nm"};
  recording.columns.resize(3);
  const double phase = random.uniform(0, 6);
  for (int i = 0; i < 2000; ++i) {
    const double t = i * period_s;
    double q = 0, then = 0, second = 0;
    for (const double hertz : {0.4, 0.9, 1.7}) {
      const double omega = 2 * M_PI * hertz, part = 0.25 * std::sin(omega * (t + later_s) + phase * hertz);
      q += 0.25 * std::sin(omega * t + phase * hertz);
      then += part;
      second -= omega * omega * part;
    }
    recording.columns[0].push_back(t);
    recording.columns[1].push_back(q + positionNoise * random.normal());
    recording.columns[2].push_back(inertia * second + weight * std::sin(then) + torqueNoise * random.normal());
  }
  return recording;
}

FitProblem prepared(double lowpass_hz, double later_s = 0) {
  GapProblem problem = hingeProblem();
  problem.scene.step_s = period_s;
  problem.scene.robots[0].servos["hinge"] = {"motion", {}};
  problem.scene.robots[0].servos["rail"] = {"motion", {}};
  problem.scene.calibrate.clear();
  std::vector<Recording> recordings;
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    recordings.push_back(followedSwing(trial, later_s));
    if (lowpass_hz > 0) recordings.back() = resampled(recordings.back(), {0, lowpass_hz});
  }
  return makeFitProblem(problem, recordings, library());
}

Eigen::VectorXd residualsOf(const FitProblem& problem) {
  std::vector<double> all;
  for (const Segment& segment : problem.segments)
    for (const double residual : btr::residualsOf(problem, segment, problem.sceneOf(problem.given, segment.trial),
                                                  std::vector<double>(segment.nuisances.size(), 0)))
      all.push_back(residual);
  EXPECT_GT(all.size(), 1000u);
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

double rootMeanSquare(const Eigen::VectorXd& residuals) {
  return std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
}

double rootMeanSquareOf(const FitProblem& problem) { return rootMeanSquare(residualsOf(problem)); }

TEST(MotionNoise, IsTheSecondDifferenceOfThePositionsNoise) {
  const FitProblem problem = prepared(0);
  // σ·√(1 + 4 + 1)/h² of the acceleration.
  const double ofMotion = inertia * positionNoise * std::sqrt(6.0) / (period_s * period_s);
  EXPECT_NEAR(problem.trials[0].noiseFloor[0], std::hypot(ofMotion, torqueNoise), 0.1 * ofMotion);
  EXPECT_NEAR(rootMeanSquareOf(problem), 1, 0.1);
}

TEST(MotionNoise, IsSaidWithTheFilterThatTakesNothingElse) {
  EXPECT_THAT(prepared(0).notes, Contains(HasSubstr("\"lowpass_hz\": ")));
  EXPECT_THAT(prepared(10).notes, Not(Contains(HasSubstr("\"lowpass_hz\": "))));
}

TEST(MotionNoise, OfAFilteredMotionIsWhatTheFilterLeft) {
  const FitProblem problem = prepared(10);
  EXPECT_LT(problem.trials[0].noiseFloor[0], 0.05);  // unfiltered: 6 N·m
  EXPECT_NEAR(rootMeanSquareOf(problem), 1, 0.2);
}

TEST(MotionNoise, TheEndsOfAFilterAreNotCompared) {
  const FitProblem problem = prepared(10);
  const std::vector<double>& time = problem.trials[0].recording.columns[0];
  for (const Segment& segment : problem.segments)
    for (const std::size_t row : segment.row) {
      EXPECT_GE(time[row], 0.6 - 1e-9);
      EXPECT_LE(time[row], time.back() - 0.6 + 1e-9);
    }
}

// What was asked for from its row to the next belongs to the middle between them.
TEST(MotionNoise, ATorqueHalfARowLaterIsNoPhysics) {
  const FitProblem problem = prepared(10, period_s / 2);
  Eigen::VectorXd residuals = residualsOf(problem);
  const double before = rootMeanSquare(residuals);
  const Alignment alignment = align(problem, residuals);
  EXPECT_NEAR(std::abs(alignment.shift_s), period_s / 2, 0.1 * period_s);
  EXPECT_GT(before, 1.5);
  EXPECT_NEAR(rootMeanSquare(residuals), 1, 0.2);
}

/// The hinge swings a little, by a torque of three sines that is held from row to row. The torque is recorded, or
/// commanded, with noise of which the hinge knows nothing.
Recording swingUnderTorque(std::uint64_t number, const std::string& torque, double recordedNoise) {
  constexpr double finePosition = 2e-5;
  constexpr int substeps = 100;
  Random random = Random::forPurpose(12, "swing", number);
  Recording recording;
  recording.source = "swing_" + std::to_string(number) + ".csv";
  recording.channels = {"time_s", "rig.hinge.position_rad", "rig.hinge." + torque};
  recording.columns.resize(3);
  const double phase = random.uniform(0, 6), h = period_s / substeps;
  double q = 0, rate = 0;
  for (int i = 0; i < 3000; ++i) {
    const double t = i * period_s;
    double sum = 0;
    for (const double hertz : {0.4, 0.7, 1.7}) sum += 0.03 * std::sin(2 * M_PI * hertz * t + phase * hertz);
    recording.columns[0].push_back(t);
    recording.columns[1].push_back(q + finePosition * random.normal());
    recording.columns[2].push_back(sum + recordedNoise * random.normal());
    for (int k = 0; k < substeps; ++k) {
      rate += h * (sum - weight * std::sin(q)) / inertia;
      q += h * rate;
    }
  }
  return recording;
}

constexpr double littleNoise = 5e-3, muchNoise = 0.5;

GapProblem drivenBy(const std::string& torque, double recordedNoise) {
  GapProblem problem = hingeProblem();
  problem.scene.step_s = problem.scene.controlPeriod_s = period_s;
  problem.scene.robots[0].servos["hinge"] = {"torque", {}};
  problem.scene.calibrate.clear();
  for (std::uint64_t trial = 0; trial < 6; ++trial)
    problem.recordings.push_back(swingUnderTorque(trial, torque, recordedNoise));
  return problem;
}

FitProblem preparedUnder(const std::string& torque) {
  const GapProblem problem = drivenBy(torque, littleNoise);
  return makeFitProblem(problem, problem.recordings, library(), 1);
}

TEST(TorqueNoise, IsTheSecondIntegralOfTheTorquesNoise) {
  const FitProblem problem = preparedUnder("torque_nm");
  // White noise a of the acceleration, held for h, on a pendulum of frequency ω: a²·h/(2ω²)·(t − sin(2ωt)/2ω) after t.
  const double noise = littleNoise / inertia, omega = std::sqrt(weight / inertia);
  const double meanSquare =
      noise * noise * period_s / (2 * omega * omega) * (0.5 - (1 - std::cos(2 * omega)) / (4 * omega * omega));
  EXPECT_NEAR(problem.trials[0].noiseFloor[0] / std::sqrt(meanSquare), 1, 0.25);
  EXPECT_NEAR(rootMeanSquareOf(problem), 1, 0.25);
  EXPECT_THAT(problem.notes, Contains(AllOf(HasSubstr("position_rad: the noise of the recorded torques"),
                                            HasSubstr("\"drive\": \"motion\""))));
}

TEST(TorqueNoise, IsNotInACommand) { EXPECT_LT(preparedUnder("command_nm").trials[0].noiseFloor[0], 4e-5); }

TEST(TorqueNoise, ThatHidesTheMotionNamesNothingAndTheWayRoundIt) {
  const GapReport report = analyse(drivenBy("torque_nm", muchNoise), library(), {});
  EXPECT_EQ(report.verdict, GapReport::Verdict::notExcited) << report.sentence;
  EXPECT_THAT(report.nextStep, HasSubstr("\"drive\": \"motion\""));
}

}  // namespace input_noise
}  // namespace btr
