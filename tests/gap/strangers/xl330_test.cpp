// The XL330 servo that swings a pendulum: our world against a formula stepped here, and both against the real
// recordings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/initial_state.h"
#include "core/gap/replay/residual.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

const std::string xl330Scene = SOURCE_DIR "/resources/scenes/xl330.json";
const std::string mappingPath = SOURCE_DIR "/resources/scenes/xl330.mapping.json";
const std::string frictionPath = SOURCE_DIR "/resources/scenes/xl330_friction.simulator.json";

/// The two recordings in tests/data.
std::vector<std::string> ownRecordings() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(SOURCE_DIR "/tests/data/bam_xl330"))
    if (entry.path().extension() == ".csv") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// All twelve, where they are: $UCHILSIM_RECORDINGS/bam_xl330/csv or beside the project.
std::vector<std::string> allRecordings() {
  const char* given = std::getenv("UCHILSIM_RECORDINGS");
  const fs::path folder = fs::path(given ? given : SOURCE_DIR "/../shared/recordings") / "bam_xl330" / "csv";
  std::vector<std::string> paths;
  if (!fs::is_directory(folder)) return paths;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// J q̈ = kt·V·duty/R − kt² q̇/R − m g l sin q − viscous·q̇ − Coulomb, duty = clip(kp·(goal − q)·(4096/2π)/(256·885), ±1);
/// switched off: no motor torque. Semi-implicit Euler, steps of at most 0.1 ms, dry friction stops but never reverses.
/// Numbers: the authors' fit of their model m1 (authors_fit_af22604_m1.json of the recordings).
std::vector<double> steppedFormula(const Recording& trial, double kp, double coulomb, double viscous) {
  const double kt = 0.32321138819018436, resistance = 4.7636501514851926, armature = 0.001643216859746982;
  const double mass = 0.49, length = 0.1, gravity = 9.80665;
  const double inertia = mass * length * length + 1e-6 + armature;
  const double gain = kp * (4096 / (2 * M_PI)) / (256.0 * 885.0);
  const auto column = [&](const char* name) {
    return trial.columns[static_cast<std::size_t>(trial.column(std::string("xl330.shoulder.") + name))];
  };
  const auto time = trial.columns[0], goal = column("command_rad"), enabled = column("enabled"),
             volts = column("voltage_v"), measured = column("position_rad");
  double q = estimateStart(time, measured).position, rate = 0;
  std::vector<double> simulated{q};
  for (std::size_t row = 0; row + 1 < time.size(); ++row) {
    const double interval = time[row + 1] - time[row];
    const double steps = std::ceil(interval / 1e-4);
    const double h = interval / steps;
    for (int i = 0; i < steps; ++i) {
      double torque = -mass * gravity * length * std::sin(q), damping = viscous;
      if (enabled[row] > 0.5) {
        torque += kt * volts[row] * std::clamp(gain * (goal[row] - q), -1.0, 1.0) / resistance;
        damping += kt * kt / resistance;
      }
      const double effective = inertia + h * damping;
      const double next = (inertia * rate + h * torque) / effective;
      const double stop = h * coulomb / effective;
      rate = std::abs(next) <= stop ? 0 : next - std::copysign(stop, next);
      q += h * rate;
    }
    simulated.push_back(q);
  }
  return simulated;
}

double gainOf(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  return std::stod(name.substr(name.find("_kp") + 3));
}

double meanAbsolute(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

/// Position errors only, by recording.
std::vector<ChannelError> positionErrors(const std::vector<std::string>& paths, const std::string& simulator) {
  const ResidualReport report =
      runResidual({.scene = xl330Scene, .recordings = paths, .mapping = "", .simulator = simulator, .out = ""}, {});
  std::vector<ChannelError> errors;
  for (const ChannelError& error : report.channels)
    if (error.channel == "xl330.shoulder.position_rad") errors.push_back(error);
  return errors;
}

void worldFollowsTheFormula(const std::vector<std::string>& paths, bool friction) {
  const Mapping mapping = loadMapping(mappingPath);
  const auto errors = positionErrors(paths, friction ? frictionPath : "");
  ASSERT_EQ(errors.size(), paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Recording trial = loadRecording(paths[i], &mapping);
    const auto formula = steppedFormula(trial, gainOf(paths[i]), friction ? 0.0069659724474934286 : 0,
                                        friction ? 0.010494765451601431 : 0);
    const double error = meanAbsolute(formula, errors[i].recorded);
    const double apart = meanAbsolute(formula, errors[i].simulated);
    // Steps of 0.25 and 0.1 ms may differ by little beside what both miss.
    EXPECT_LT(apart, 0.02 * error) << paths[i];
    EXPECT_NEAR(errors[i].meanAbsolute, error, 0.01 * error) << paths[i];
  }
}

TEST(Xl330, ReplayFollowsTheSteppedFormula) { worldFollowsTheFormula(ownRecordings(), false); }
TEST(Xl330, ReplayWithFrictionFollowsTheSteppedFormula) { worldFollowsTheFormula(ownRecordings(), true); }

TEST(Xl330, EveryRecordingsReplayFollowsTheSteppedFormula) {
  const auto paths = allRecordings();
  if (paths.empty()) GTEST_SKIP() << "bam_xl330 recordings are absent (set UCHILSIM_RECORDINGS); nothing was compared";
  EXPECT_EQ(paths.size(), 12u);
  worldFollowsTheFormula(paths, false);
  worldFollowsTheFormula(paths, true);
}

TEST(Xl330, ErrorsAreThoseOfTheLiteraturesModels) {
  const auto paths = allRecordings();
  if (paths.empty()) GTEST_SKIP() << "bam_xl330 recordings are absent (set UCHILSIM_RECORDINGS); nothing was compared";
  const auto mean = [](const std::vector<ChannelError>& errors) {
    double sum = 0;
    for (const ChannelError& error : errors) sum += error.meanAbsolute / static_cast<double>(errors.size());
    return sum;
  };
  // Published for these parameters over 16 recordings (12 of them are here): 0.0599 rad with Coulomb and viscous
  // friction, 0.1186 rad with friction set to zero.
  const double plain = mean(positionErrors(paths, "")), friction = mean(positionErrors(paths, frictionPath));
  EXPECT_NEAR(friction, 0.0599, 0.003);
  EXPECT_NEAR(plain, 0.1186, 0.02);
  RecordProperty("plain", std::to_string(plain));
  RecordProperty("friction", std::to_string(friction));
}

// Recordings with gains 100 and 200 leave it open whether the supply sags or the motor's torque is limited. The limit
// has two numbers and fits a little better, and with a gain of 800 it is off by 0.14 rad: the simpler law goes into the
// simulator. Published: 0.048 rad with load-dependent friction, at a gain between the fitted ones.
TEST(Xl330, OfLawsThatAreNotToldApartTheSimplerHoldsAtAnotherGain) {
  AnalysisRequest request;
  for (const std::string& path : allRecordings())
    (gainOf(path) == 800 ? request.heldOut : request.recordings).push_back(path);
  if (request.heldOut.empty())
    GTEST_SKIP() << "bam_xl330 recordings are absent (set UCHILSIM_RECORDINGS); nothing was analysed";
  request.scene = xl330Scene;
  request.options.jobs = 2;
  request.options.effects = {"load_dependent_friction", "voltage_sag", "torque_speed_limit", "force_offset"};
  request.options.learnRest = request.options.designNext = false;
  const GapReport report = runAnalysis(request, library());
  const auto position = std::ranges::find(report.channels, "xl330.shoulder.position_rad", &GapReport::Channel::name);
  ASSERT_NE(position, report.channels.end());
  EXPECT_LT(position->heldoutMaeWithEffects, 0.048) << toPlainText(report);
  EXPECT_LT(position->heldoutMaeWithEffects, 0.5 * position->heldoutMaeCalibrated) << toPlainText(report);
}

}  // namespace
}  // namespace btr
