// A servo that hunts, told from one that is shaken by its command, rings as the simulator does, or is only noisy.
#include "core/gap/search/trials/self_excited.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using Law = std::function<double(double)>;

constexpr double period_s = 0.004, noise = 0.0015;

double wave(double t, double frequency_hz) { return std::sin(2 * std::numbers::pi * frequency_hz * t); }

/// What a servo is told at most: slow.
double slow(double t) { return 0.3 * wave(t, 0.7); }

/// Grows to 0.03 within 4 s, from below the noise before the last of them.
double grown(double t, double frequency_hz) { return 0.03 * std::exp((t - 4) / 0.4) * wave(t, frequency_hz); }

struct Rig {
  FitProblem problem;
  std::vector<GapReport::Trial> trials;
};

/// Four seconds of one joint.
Rig rig(const Law& recorded, const Law& simulated, const Law& command,
        const std::string& commanded = "rig.hinge.command_rad") {
  Random random(5);
  FitTrial trial;
  trial.recording.channels = {"time_s", commanded, "rig.hinge.position_rad"};
  trial.recording.columns.resize(3);
  trial.binding.inputs = {{Binding::Input::What::command, 0, 0, 1}};
  trial.binding.measured = {{Binding::Measured::What::position, 0, 0, 2}};
  trial.noiseFloor = {noise};
  GapReport::Series series;
  series.channel = "rig.hinge.position_rad";
  series.noiseFloor = noise;
  for (int row = 0; row <= 1000; ++row) {
    const double t = row * period_s;
    trial.recording.columns[0].push_back(t);
    trial.recording.columns[1].push_back(command(t));
    trial.recording.columns[2].push_back(recorded(t) + noise * random.normal());
    series.withEffects.push_back(simulated(t));
  }
  series.recorded = trial.recording.columns[2];
  Rig made;
  made.problem.trials = {trial};
  GapReport::Trial out;
  out.name = "swing.csv";
  out.time_s = trial.recording.columns[0];
  out.series = {series};
  made.trials = {out};
  return made;
}

std::optional<SelfExcitedSwing> swingOf(const Rig& made) { return selfExcitedSwing(made.problem, made.trials); }

TEST(SelfExcited, TellsWhenHowFastAndHowFar) {
  for (const double frequency : {6.0, 9.6, 40.0}) {
    const auto swing = swingOf(rig([&](double t) { return slow(t) + grown(t, frequency); }, slow, slow));
    ASSERT_TRUE(swing) << frequency;
    EXPECT_EQ(swing->channel, "rig.hinge.position_rad");
    EXPECT_EQ(swing->trial, "swing.csv");
    EXPECT_NEAR(swing->from_s, 8.0 / 3, 0.01);
    EXPECT_NEAR(swing->to_s, 4, 0.01);
    EXPECT_NEAR(swing->frequency_hz, frequency, 1.5 / (4.0 / 3)) << "within a bin and a half";
    EXPECT_LT(swing->amplitude, 0.03);
    EXPECT_GT(swing->amplitude, 0.003) << "in the middle of the third it is exp(−0.67/0.4) of its end";
  }
}

TEST(SelfExcited, AmplitudeIsThatOfASteadyWave) {
  const auto swing = swingOf(rig([](double t) { return slow(t) + 0.02 * wave(t, 12); }, slow, slow));
  ASSERT_TRUE(swing);
  EXPECT_NEAR(swing->amplitude, 0.02, 0.0005);
  EXPECT_NEAR(swing->frequency_hz, 12, 0.75);
}

TEST(SelfExcited, WhatTheCommandAsksForIsNoHunting) {
  const Law shaken = [](double t) { return slow(t) + 0.02 * wave(t, 9.6); };
  EXPECT_FALSE(swingOf(rig(shaken, slow, shaken)));
}

TEST(SelfExcited, WhatTheSimulatorDoesTooIsNoHunting) {
  const Law ringing = [](double t) { return slow(t) + 0.02 * wave(t, 9.6); };
  const Law nearly = [](double t) { return slow(t) + 0.015 * wave(t, 9.6); };
  EXPECT_FALSE(swingOf(rig(ringing, nearly, slow)));
}

TEST(SelfExcited, NoiseAndSlowErrorsAreNoHunting) {
  EXPECT_FALSE(swingOf(rig(slow, slow, slow)));
  EXPECT_FALSE(swingOf(rig([](double t) { return 0.8 * slow(t); }, slow, slow)));
  EXPECT_FALSE(swingOf(rig([](double t) { return slow(t) + 0.003 * wave(t, 9.6); }, slow, slow)))
      << "1.4 noise floors, r.m.s.";
}

TEST(SelfExcited, AJointThatIsPushedByATorqueSwingsAsItLikes) {
  EXPECT_FALSE(swingOf(rig([](double t) { return slow(t) + 0.02 * wave(t, 9.6); }, slow, slow, "rig.hinge.torque_nm")));
}

TEST(SelfExcited, ShortTrialsTellNothing) {
  Rig made = rig([](double t) { return 0.02 * wave(t, 9.6); }, slow, slow);
  for (auto& column : made.problem.trials[0].recording.columns) column.resize(60);
  made.trials[0].series[0].recorded.resize(60);
  made.trials[0].series[0].withEffects.resize(60);
  EXPECT_FALSE(swingOf(made));
}

}  // namespace
}  // namespace btr
