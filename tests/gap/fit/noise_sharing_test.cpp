// What a channel that stands still is known to.
#include "core/gap/fit/noise_sharing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/noise_floor.h"
#include "core/spec/random.h"
#include "tests/gap/recorded_hinge.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double count_rad = 2 * M_PI / 4096;

std::vector<double> still(double value) { return std::vector<double>(400, value); }

std::vector<double> quantised() {
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(std::round(0.5 * std::sin(0.02 * i) / count_rad) * count_rad);
  return values;
}

std::vector<double> noisy(double noise) {
  Random random(3);
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(noise * random.normal());
  return values;
}

FitTrial trialOf(const std::vector<std::pair<std::string, std::vector<double>>>& columns) {
  FitTrial trial;
  trial.recording.channels = {"time_s"};
  trial.recording.columns = {still(0)};
  for (const auto& [name, values] : columns) {
    trial.binding.measured.push_back(
        {Binding::Measured::What::position, 0, trial.binding.measured.size(), trial.recording.channels.size()});
    trial.recording.channels.push_back(name);
    trial.recording.columns.push_back(values);
  }
  return trial;
}

std::vector<std::string> shared(std::vector<FitTrial>& trials) {
  std::vector<std::string> notes;
  shareNoiseFloors(trials, notes);
  return notes;
}

TEST(NoiseSharing, TakesTheMedianOfTheTrialsThatShowTheNoiseHoweverManyStandStill) {
  std::vector<FitTrial> trials;
  for (int i = 0; i < 5; ++i) trials.push_back(trialOf({{"leg.knee.position_rad", still(0.25)}}));
  trials.push_back(trialOf({{"leg.knee.position_rad", noisy(0.001)}}));
  EXPECT_THAT(shared(trials), IsEmpty());
  for (const FitTrial& trial : trials) EXPECT_EQ(trial.noiseFloor[0], resolution(noisy(0.001)));
}

/// Even samples, every 10 ms, of a swing, with stamps that are off by a millisecond.
FitTrial jittering(double amplitude, std::uint64_t seed) {
  constexpr double noise = 0.001, jitter_s = 0.001;
  Random random(seed);
  FitTrial trial = trialOf({{"leg.knee.position_rad", still(0)}});
  for (std::size_t i = 0; i < 400; ++i) {
    const double time = 0.01 * static_cast<double>(i);
    trial.recording.columns[0][i] = time + jitter_s * random.normal();
    trial.recording.columns[1][i] = amplitude * std::sin(5 * time) + noise * random.normal();
  }
  return trial;
}

// Only the fast one shows that stamps are off, and all of them are from one logger.
TEST(NoiseSharing, CountsSpeedTimesJitterInAllTrialsWhereOneShowsIt) {
  std::vector<FitTrial> trials;
  double squares = 0;
  for (const double amplitude : {0.6, 0.2, 0.2, 0.2}) {
    trials.push_back(jittering(amplitude, trials.size() + 1));
    squares += std::pow(0.001, 2) + std::pow(0.001 * amplitude * 5, 2) / 2;
  }
  shared(trials);
  for (const FitTrial& trial : trials) EXPECT_NEAR(trial.noiseFloor[0], std::sqrt(squares / 4), 1.5e-4);
}

// Known worse where it moves faster, and no other than before where stamps are right.
TEST(NoiseSharing, GivesEachSampleThePartOfItsOwnSpeedWhereStampsJitter) {
  std::vector<FitTrial> trials{jittering(0.6, 1), jittering(0.6, 2)};
  shared(trials);
  double squares = 0;
  for (const FitTrial& trial : trials) {
    ASSERT_TRUE(trial.hasSampleFloors(0));
    for (std::size_t row = 1; row + 1 < 400; ++row) {
      const double speed = 0.6 * 5 * std::cos(0.05 * static_cast<double>(row));
      EXPECT_NEAR(trial.floorAt(0, row), std::hypot(0.001, 0.001 * speed), 4e-4) << row;
    }
    for (std::size_t row = 0; row < 400; ++row) squares += std::pow(trial.floorAt(0, row), 2);
  }
  EXPECT_NEAR(trials[0].noiseFloor[0], std::sqrt(squares / 800), 1e-12);
  std::vector<FitTrial> even{trialOf({{"leg.knee.position_rad", noisy(0.001)}})};
  shared(even);
  EXPECT_FALSE(even[0].hasSampleFloors(0));
  EXPECT_EQ(even[0].floorAt(0, 7), even[0].noiseFloor[0]);
}

// In each sample its counts hide what the jitter does; all of them together tell.
TEST(NoiseSharing, FindsJitterBesideCoarseCountsAndNoneWhereValuesFollowTheirStamps) {
  constexpr double counts = 0.0075;
  const auto rounded = [](double value) { return counts * std::round(value / counts); };
  std::vector<FitTrial> rows{jittering(0.8, 1), jittering(0.8, 2)}, stamps = rows;
  for (FitTrial& trial : rows)
    for (double& value : trial.recording.columns[1]) value = rounded(value);
  for (FitTrial& trial : stamps)
    for (std::size_t i = 0; i < 400; ++i)
      trial.recording.columns[1][i] = rounded(0.8 * std::sin(5 * trial.recording.columns[0][i]));
  shared(rows);
  shared(stamps);
  ASSERT_TRUE(rows[0].hasSampleFloors(0));
  EXPECT_GT(rows[0].floorAt(0, 126), 1.2 * rows[0].floorAt(0, 31));  // at 4 rad/s, and where it turns
  EXPECT_FALSE(stamps[0].hasSampleFloors(0));
}

// The command is replayed at a stamp that is off, too: what follows a step is late as a whole, what follows many small
// changes is not.
TEST(NoiseSharing, CountsTheJitterOfACommandTwiceAfterAStepOnly) {
  FitTrial step = jittering(0.6, 1);
  step.binding.inputs.push_back({Binding::Input::What::command, 0, 0, 2});
  step.recording.channels.push_back("leg.knee.command_rad");
  step.recording.columns.push_back(std::vector<double>(400, 0));
  FitTrial ramp = step;
  for (std::size_t row = 0; row < 400; ++row) {
    step.recording.columns[2][row] = row < 100 ? 0 : 1;
    ramp.recording.columns[2][row] = 0.01 * static_cast<double>(row);
  }
  std::vector<FitTrial> trials{step, ramp};
  shared(trials);
  constexpr std::size_t fast = 126;  // a crossing of zero: 3 rad/s
  EXPECT_NEAR(trials[0].floorAt(0, fast), std::hypot(0.001, std::sqrt(2.0) * 0.003), 5e-4);
  EXPECT_NEAR(trials[1].floorAt(0, fast), std::hypot(0.001, 0.003), 4e-4);
}

TEST(NoiseSharing, CountsSpeedTimesJitterWhereValuesAreTooSparseToTell) {
  std::vector<FitTrial> trials;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    trials.push_back(jittering(0.2, seed));
    for (std::size_t row = 0; row < 400; ++row)
      if (row % 4 != 0) trials.back().recording.columns[1][row] = NAN;
  }
  shared(trials);
  const double ofTime = 0.001 * 0.2 * 5 / std::sqrt(2.0);
  for (const FitTrial& trial : trials) EXPECT_GT(trial.noiseFloor[0], std::hypot(0.0009, 0.9 * ofTime));
}

// Seven samples a swing.
TEST(NoiseSharing, LeavesOutTrialsWhoseFastMotionPassesForNoise) {
  std::vector<double> fast = noisy(0.001);
  for (std::size_t i = 0; i < fast.size(); ++i) fast[i] += 0.6 * std::sin(0.9 * static_cast<double>(i));
  std::vector<FitTrial> trials;
  for (int i = 0; i < 4; ++i) trials.push_back(trialOf({{"leg.knee.position_rad", fast}}));
  trials.push_back(trialOf({{"leg.knee.position_rad", noisy(0.001)}}));
  EXPECT_THAT(shared(trials), IsEmpty());
  for (const FitTrial& trial : trials) EXPECT_NEAR(trial.noiseFloor[0], 0.001, 1e-4);
}

TEST(NoiseSharing, TakesThatOfAnotherJointWhereAJointStandsStillInAllTrials) {
  std::vector<FitTrial> trials{trialOf({{"leg.knee.position_rad", still(0)},
                                        {"leg.hip.position_rad", quantised()},
                                        {"leg.hip.velocity_rad_s", noisy(0.3)}})};
  EXPECT_THAT(shared(trials), ElementsAre(testing::AllOf(HasSubstr("leg.knee.position_rad: stands still"),
                                                         HasSubstr("is that of leg.hip.position_rad"))));
  EXPECT_EQ(trials[0].noiseFloor[0], resolution(quantised()));
}

TEST(NoiseSharing, TakesTheRoundingOfTheArithmeticForNoNoise) {
  for (const double value : {-0.012272, 0.1, -1.0 / 3, 77.7}) {
    std::vector<FitTrial> trials{
        trialOf({{"leg.knee.position_rad", still(value)}, {"leg.hip.position_rad", noisy(0.01)}})};
    EXPECT_EQ(shared(trials).size(), 1u) << value;
    EXPECT_EQ(trials[0].noiseFloor[0], trials[0].noiseFloor[1]) << value;
  }
}

TEST(NoiseSharing, TakesTheAxesOfABallAlike) {
  std::vector<FitTrial> trials{trialOf({{"ball.x_m", noisy(0.002)}, {"ball.z_m", still(0.04)}})};
  shared(trials);
  EXPECT_EQ(trials[0].noiseFloor[1], trials[0].noiseFloor[0]);
}

TEST(NoiseSharing, TakesTheRoundingOfTheFileWhereNothingElseTells) {
  std::vector<FitTrial> trials{trialOf({{"leg.knee.position_rad", still(0)}})};
  trials[0].recording.places.lastDigit = {0.01, 0.0001};
  EXPECT_THAT(shared(trials), ElementsAre(HasSubstr("the rounding of the file's decimals")));
  EXPECT_NEAR(trials[0].noiseFloor[0], 0.0001 / std::sqrt(12.0), 1e-12);
  trials[0].recording.places.lastDigit.clear();
  EXPECT_THAT(shared(trials), ElementsAre(HasSubstr("a guess")));
  EXPECT_GT(trials[0].noiseFloor[0], 0);
}

TEST(NoiseSharing, SaysWhereThereAreTooFewNumbers) {
  std::vector<double> few = still(std::nan(""));
  few[10] = 0.25;
  few[300] = 0.5;
  std::vector<FitTrial> trials{trialOf({{"leg.knee.position_rad", few}})};
  trials[0].recording.places.lastDigit = {0.01, 0.001};
  EXPECT_THAT(shared(trials), ElementsAre(HasSubstr("leg.knee.position_rad: has too few numbers to show its noise")));
  EXPECT_NEAR(trials[0].noiseFloor[0], 0.001 / std::sqrt(12.0), 1e-12);
}

TEST(NoiseSharing, LeavesAColumnWithoutNumbersOut) {
  std::vector<FitTrial> trials{
      trialOf({{"leg.knee.position_rad", still(std::nan(""))}, {"leg.hip.position_rad", noisy(0.1)}})};
  EXPECT_THAT(shared(trials), IsEmpty());
  EXPECT_EQ(trials[0].noiseFloor[0], 0);
}

TEST(NoiseSharing, ATrialWithoutAnyNumberIsRefused) {
  GapProblem problem = recordedInItsSteps();
  for (double& value : problem.recordings[1].columns[2]) value = std::nan("");
  EXPECT_THAT(test::refusal([&] { makeFitProblem(problem, problem.recordings, library(), 0); }),
              HasSubstr("trial_1.csv (rig.hinge.position_rad): a column without any number is not allowed"));
}

}  // namespace
}  // namespace btr
