// Scenes and mappings of the real recordings, against what the recordings' own descriptions say. The recordings lie
// beside the project or in $UCHILSIM_RECORDINGS.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/inverse.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/start_state.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

std::string scenePath(const std::string& name) { return SOURCE_DIR "/resources/scenes/" + name + ".json"; }

Scene sceneNamed(const std::string& name, const Values& values = {}) {
  const SceneSpec spec = loadScene(scenePath(name));
  return makeScene(spec, loadModels(spec), {values, {}}, {});
}

fs::path recordings() {
  const char* given = std::getenv("UCHILSIM_RECORDINGS");
  return fs::path(given ? given : SOURCE_DIR "/../shared/recordings");
}

std::vector<Recording> trialsOf(const std::string& scene, const fs::path& file) {
  return loadTrialsFor(file.string(), "", scenePath(scene));
}

const std::vector<double>& column(const Recording& recording, const std::string& name) {
  const int found = recording.column(name);
  EXPECT_GE(found, 0) << name;
  return recording.columns[static_cast<std::size_t>(std::max(found, 0))];
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// ½·a of the parabola through the first `count` samples.
double curvature(const std::vector<double>& t, const std::vector<double>& z, std::size_t count) {
  Eigen::MatrixXd powers(count, 3);
  Eigen::VectorXd heights(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    powers.row(row) << 1, t[i] - t[0], (t[i] - t[0]) * (t[i] - t[0]);
    heights[row] = z[i];
  }
  return 2 * powers.colPivHouseholderQr().solve(heights)[2];
}

TEST(RealScenes, AllLoadAndTheirCalibratedNumbersExist) {
  for (const char* name : {"emps", "emps_motion", "multiarm_single", "multiarm_double", "dfki", "dfki_motion",
                           "contactnets_cube", "xl330"}) {
    const SceneSpec spec = loadScene(scenePath(name));
    EXPECT_FALSE(spec.calibrate.empty()) << name;
    Values middle;
    for (const CalibratePath& path : spec.calibrate) middle[path.path] = (path.minimum + path.maximum) / 2;
    EXPECT_NO_THROW(makeScene(spec, loadModels(spec), {middle, {}}, {})) << name;
    EXPECT_NO_THROW(loadMapping(SOURCE_DIR "/resources/scenes/" + std::string(name) + ".mapping.json"));
  }
}

TEST(RealScenes, EmpsServoIsItsCascadedController) {
  // u = kv·(kp·(q_ref − q) − q̇) within ±10 V, force = gtau·u.
  const double gtau = 35.15065, kv = 243.45, kp = 160.18;
  const Drive drive = sceneNamed("emps").robots[0].drives[0];
  EXPECT_NEAR(drive.p, gtau * kv * kp, 1);
  EXPECT_NEAR(drive.d, gtau * kv, 1e-3);
  EXPECT_NEAR(drive.maxTorque, gtau * 10, 1e-9);
  EXPECT_NEAR(sceneNamed("emps").robots[0].model.links[1].inertial.mass_kg, 95.1089, 1e-12);
}

TEST(RealScenes, EmpsForceIsGainTimesVoltageAndPulsesShiftTheCommand) {
  const fs::path folder = recordings() / "emps";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "emps recordings are absent; nothing was compared";
  const Recording plain = trialsOf("emps", folder / "DATA_EMPS.csv")[0];
  const Recording pulses = trialsOf("emps", folder / "DATA_EMPS_PULSES.csv")[0];
  const auto& force = column(plain, "emps.slide.force_n");
  const auto& volts = column(plain, "u_V");
  for (std::size_t i = 0; i < plain.rows(); i += 100) EXPECT_NEAR(force[i], 35.15065 * volts[i], 1e-5);

  // Both follow the same reference; a pulse adds 5.069 V to what the controller says.
  const auto& reference = column(plain, "emps.slide.command_m");
  const auto& shifted = column(pulses, "emps.slide.command_m");
  EXPECT_NEAR(shifted[300] - reference[300], 0, 1e-9);
  EXPECT_NEAR(shifted[600] - reference[600], 5.0695 / (243.45 * 160.18), 1e-8);
  // With it the controller's law gives the recorded voltage: between samples its rate is that of two samples' mean.
  const auto& q = column(pulses, "emps.slide.position_m");
  const auto& u = column(pulses, "u_V");
  std::vector<double> misses;
  for (std::size_t i = 2; i < pulses.rows(); ++i) {
    const double rate = (q[i] - q[i - 2]) / 0.002;
    misses.push_back(std::abs(u[i] - 243.45 * (160.18 * (shifted[i] - q[i]) - rate)));
  }
  EXPECT_LT(median(misses), 0.02);
}

TEST(RealScenes, EmpsForceErrorsArePublishedOnes) {
  const fs::path folder = recordings() / "emps";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "emps recordings are absent; nothing was compared";
  // The published offset of −3.1648 N on the motor's side, as the pull of a gravity component.
  const Scene published = sceneNamed("emps", {{"robots.emps.joints.slide.viscous_friction_n_s_m", 203.5034},
                                              {"robots.emps.joints.slide.coulomb_friction_n", 20.3935},
                                              {"gravity_m_s2.x", 3.1648 / 95.1089}});
  const double expected[]{4.04, 5.95};
  const double massOnly[]{69.4, 67.2};
  int i = 0;
  for (const char* name : {"DATA_EMPS.csv", "DATA_EMPS_PULSES.csv"}) {
    const auto trials = trialsOf("emps", folder / name);
    EXPECT_NEAR(inverse(published, trials, {}).joints[0].relative, expected[i], 0.05) << name;
    EXPECT_NEAR(inverse(sceneNamed("emps"), trials, {}).joints[0].relative, massOnly[i], 0.6) << name;
    ++i;
  }
}

TEST(RealScenes, MultiArmHangsDownAtZeroAndSwingsAsItsNumbersSay) {
  const fs::path folder = recordings() / "multiarm_pendulum";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "multiarm recordings are absent; nothing was compared";
  const auto trials = trialsOf("multiarm_single", folder / "single_freeswing_vad.csv");
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_NEAR(trials[0].columns[0].back() - trials[0].columns[0].front(), 9.17, 0.01);
  // θ'' = −m·g·a/(I + m·a²)·sin θ about the hanging position.
  const double m = 0.147585, a = 0.147755, inertia = 1.0912e-4;
  double up = 0, down = 0;
  const auto& q = column(trials[1], "pendulum.arm1.position_rad");
  const auto& rate = column(trials[1], "pendulum.arm1.velocity_rad_s");
  for (std::size_t i = 10; i + 10 < q.size(); ++i) {
    const double acceleration = (rate[i + 10] - rate[i - 10]) / 0.020;
    up -= acceleration * std::sin(q[i]);
    down += std::sin(q[i]) * std::sin(q[i]);
  }
  EXPECT_NEAR(up / down, m * 9.81 * a / (inertia + m * a * a), 1.0);
}

TEST(RealScenes, MultiArmWithoutFrictionMissesAsMuchAsMeasured) {
  const fs::path folder = recordings() / "multiarm_pendulum";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "multiarm recordings are absent; nothing was compared";
  const auto trials = trialsOf("multiarm_single", folder / "single_freeswing_vad.csv");
  const auto errorsWith = [&](const Values& values) {
    std::vector<double> errors;
    for (const ChannelError& error : residual(sceneNamed("multiarm_single", values), trials).channels)
      if (error.channel.ends_with("position_rad")) errors.push_back(error.rootMeanSquare);
    return errors;
  };
  const auto none = errorsWith({});
  EXPECT_NEAR(none[0], 0.0761, 0.002);
  EXPECT_NEAR(none[1], 0.0700, 0.002);
  const auto viscous = errorsWith({{"robots.pendulum.joints.arm1.viscous_friction_nm_s_rad", 2.2394e-4}});
  EXPECT_NEAR(viscous[0], 0.0147, 0.002);
  EXPECT_NEAR(viscous[1], 0.0205, 0.002);
}

TEST(RealScenes, TheSecondArmsAngleIsRelative) {
  const fs::path folder = recordings() / "multiarm_pendulum";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "multiarm recordings are absent; nothing was compared";
  const auto trials = trialsOf("multiarm_double", folder / "double_freeswing_vad.csv");
  ASSERT_EQ(trials.size(), 4u);
  EXPECT_NEAR(column(trials[0], "pendulum.arm1.position_rad")[0], 3.155234 - M_PI, 1e-9);
  EXPECT_NEAR(column(trials[0], "pendulum.arm2.position_rad")[0], 3.174161 - 3.155234, 1e-9);
  // A wrong sign or an absolute angle would not follow the recorded swing to a hundredth of its size.
  for (const ChannelError& error : residual(sceneNamed("multiarm_double"), trials).channels)
    if (error.channel.ends_with("position_rad")) {
      EXPECT_LT(error.rootMeanSquare, 0.01) << error.channel;
    }
}

TEST(RealScenes, DfkiInertiasAboutTheJointsAreThoseOfItsModel) {
  const Scene scene = sceneNamed("dfki");
  const auto& links = scene.robots[0].model.links;
  const double expected[]{0.031887199591513114, 0.05086984812807257};
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Inertial& inertial = links[i].inertial;
    EXPECT_NEAR(inertial.inertia_kg_m2(1, 1) + inertial.mass_kg * inertial.centreOfMass_m.squaredNorm(),
                expected[i - 1], 1e-9);
  }
}

TEST(RealScenes, DfkiHangsAtRestWithoutTorque) {
  const fs::path folder = recordings() / "dfki_double_pendulum" / "design_C1_sysid_20230629";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "dfki recordings are absent; nothing was compared";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const Recording trial = trialsOf("dfki", entry.path())[0];
    EXPECT_NEAR(column(trial, "dp.shoulder.position_rad")[0], 0, 1e-3);
    EXPECT_NEAR(column(trial, "dp.elbow.position_rad")[0], 0, 1e-3);
  }
  // The sign of torque and angle: a model that pushed the wrong way would miss by more than the torque itself.
  const auto trials = trialsOf("dfki", folder / "20230629-144115.csv");
  EXPECT_LT(inverse(sceneNamed("dfki"), trials, {5, 25}).joints[0].relative, 60);
}

class Tosses : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path folder = recordings() / "contactnets_cube" / "tosses";
    if (!fs::is_directory(folder)) GTEST_SKIP() << "contactnets recordings are absent; nothing was compared";
    for (int i = 0; i < 40; ++i) {
      const std::string number = std::to_string(i);
      trials.push_back(
          trialsOf("contactnets_cube", folder / ("toss_" + std::string(3 - number.size(), '0') + number + ".csv"))[0]);
    }
  }
  std::vector<Recording> trials;
};

TEST_F(Tosses, FallWithTheAccelerationOfTheirDescription) {
  std::vector<double> accelerations;
  for (const Recording& trial : trials)
    accelerations.push_back(curvature(trial.columns[0], column(trial, "cube.base.z_m"), 12));
  EXPECT_NEAR(median(accelerations), -9.61, 0.2);
}

TEST_F(Tosses, EndOnAFaceAtHalfTheSide) {
  for (const Recording& trial : trials) {
    const std::size_t last = trial.rows() - 1;
    EXPECT_NEAR(column(trial, "cube.base.z_m")[last], 0.0524, 0.003) << trial.source;
    const Eigen::Quaterniond q(column(trial, "cube.base.qw")[last], column(trial, "cube.base.qx")[last],
                               column(trial, "cube.base.qy")[last], column(trial, "cube.base.qz")[last]);
    EXPECT_NEAR(q.norm(), 1, 1e-5);
    // In the cube's axes "up" is one of them.
    EXPECT_GT((q.toRotationMatrix().transpose() * Eigen::Vector3d::UnitZ()).cwiseAbs().maxCoeff(), 0.99)
        << trial.source;
  }
}

TEST_F(Tosses, StartAsFastAsTheirVelocityColumnsSay) {
  const Scene scene = sceneNamed("contactnets_cube");
  std::vector<double> velocityMisses, spinMisses;
  for (const Recording& trial : trials) {
    const StartState start = startState(scene, trial, bind(scene, trial));
    const Eigen::Vector3d velocity(column(trial, "vx")[0], column(trial, "vy")[0], column(trial, "vz")[0]);
    const Eigen::Vector3d spin(column(trial, "wx")[0], column(trial, "wy")[0], column(trial, "wz")[0]);
    velocityMisses.push_back((start.robots[0].velocity_m_s - velocity).norm());
    // The columns' spin is in the cube's axes.
    spinMisses.push_back((start.robots[0].base.linear().transpose() * start.robots[0].spin_rad_s - spin).norm());
  }
  EXPECT_LT(median(velocityMisses), 0.05);
  EXPECT_LT(median(spinMisses), 0.5);
}

}  // namespace
}  // namespace btr
