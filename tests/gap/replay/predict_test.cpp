#include "core/gap/replay/predict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"
#include "tests/gap/scene_of.h"

namespace btr {
namespace {

using testing::ElementsAre;

Recording timesOnly(double duration, double period) {
  Recording recording;
  recording.source = "trial.csv";
  recording.channels = {"time_s"};
  recording.columns.emplace_back();
  for (double t = 0; t <= duration + 1e-9; t += period) recording.columns[0].push_back(t);
  return recording;
}

TEST(Predict, AThrownBallFollowsTheParabola) {
  const Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "none"})",
                               R"("balls": [{"name": "ball", "radius_m": 0.05, "mass_kg": 0.1,
                                             "position_m": [3, 0, 5], "velocity_m_s": [1, 0, 2]}])");
  const Recording predicted = predict(scene, timesOnly(0.5, 0.01));
  EXPECT_THAT(predicted.channels, ElementsAre("time_s", "rig.hinge.position_rad", "rig.rail.position_m", "ball.x_m",
                                              "ball.y_m", "ball.z_m"));
  for (std::size_t row = 0; row < predicted.rows(); ++row) {
    const double t = predicted.columns[0][row];
    EXPECT_NEAR(3 + t, predicted.columns[3][row], 1e-9);
    EXPECT_NEAR(5 + 2 * t - 9.81 / 2 * t * t, predicted.columns[5][row], 1e-6);
    EXPECT_NEAR(0, predicted.columns[1][row], 1e-9);  // hangs where it was
  }
}

TEST(Predict, CommandsStandBesideWhatTheyCause) {
  const Scene scene = rigScene(R"("hinge": {"p": 20, "d": 0.5, "max_torque_nm": 100}, "rail": {"drive": "none"})");
  Recording recording = timesOnly(3, 0.01);
  recording.channels.push_back("rig.hinge.command_rad");
  recording.columns.emplace_back(recording.rows(), 0.3);
  recording.channels.push_back("rig.hinge.position_rad");
  recording.columns.emplace_back(recording.rows(), 0.3);
  const Recording predicted = predict(scene, recording);
  ASSERT_GE(predicted.column("rig.hinge.command_rad"), 0);
  EXPECT_EQ(recording.columns[1],
            predicted.columns[static_cast<std::size_t>(predicted.column("rig.hinge.command_rad"))]);
  // At rest the servo's spring carries the weight: 20·(0.3 − q) = m·g·l·sin q.
  const double q = predicted.columns[static_cast<std::size_t>(predicted.column("rig.hinge.position_rad"))].back();
  EXPECT_NEAR(20 * (0.3 - q), 0.5 * 9.81 * 0.2 * std::sin(q), 1e-4);
}

TEST(Predict, WritesARecordingThatCanBeReadAgain) {
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  folder.write("scene.json", R"({"format": "uchilsim-scene-1", "step_s": 0.001, "robots": [{"name": "rig",
    "model": "rig.urdf", "base": "fixed", "collision": "none",
    "servos": {"hinge": {"p": 20}, "rail": {"p": 20}}}]})");
  folder.write("trial.csv", "time_s,rig.hinge.command_rad,rig.hinge.position_rad\n0,0.1,\n0.01,0.1,\n0.02,0.2,\n");
  const auto written =
      runPredict({folder.file("scene.json"), folder.file("trial.csv"), "", "", folder.file("out.csv")}, {});
  ASSERT_EQ(1u, written.size());
  const Recording again = loadRecording(folder.file("out.csv"));
  EXPECT_EQ(written[0].channels, again.channels);
  EXPECT_EQ(written[0].columns, again.columns);
  EXPECT_THROW(runPredict({folder.file("scene.json"), folder.file("absent.csv"), "", "", folder.file("out.csv")}, {}),
               InputError);
}

}  // namespace
}  // namespace btr
