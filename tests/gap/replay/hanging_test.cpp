// Servos that nobody recorded hang under their load where the scene says that they are told to be.
#include "core/gap/replay/hanging.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/replay/replay.h"
#include "core/sim/world.h"
#include "tests/gap/scene_of.h"

namespace btr {
namespace {

/// An arm of two links on a wall, both stretched out to the side: 0.4 kg in the middle of 0.2 m each.
Scene stretchedArm() {
  const char* urdf = R"(<robot name="arm">
    <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="shoulder" type="continuous"><parent link="wall"/><child link="upper"/><axis xyz="0 1 0"/></joint>
    <link name="upper"><inertial><origin xyz="0.1 0 0"/><mass value="0.4"/>
      <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="elbow" type="continuous"><origin xyz="0.2 0 0"/><parent link="upper"/><child link="lower"/>
      <axis xyz="0 1 0"/></joint>
    <link name="lower"><inertial><origin xyz="0.1 0 0"/><mass value="0.4"/>
      <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  </robot>)";
  const TemporaryFolder folder;
  folder.write("arm.urdf", urdf);
  const SceneSpec spec = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.0005, "control_period_s": 0.005,
    "robots": [{"name": "arm", "model": "arm.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none",
    "servos": {"shoulder": {"p": 12, "d": 0.5, "max_torque_nm": 9}, "elbow": {"p": 5, "d": 0.2, "max_torque_nm": 9}}}]})",
                                       "scene", folder.file("."));
  return makeScene(spec, loadModels(spec), {}, {});
}

StartState atTheScenes(const Scene& scene) {
  StartState state;
  for (const SceneRobot& robot : scene.robots)
    state.robots.push_back({.base = robot.start,
                            .positions = std::vector<double>(robot.model.joints.size(), 0.0),
                            .rates = std::vector<double>(robot.model.joints.size(), 0.0)});
  return state;
}

TEST(HangingServos, SagByTheWeightBehindThem) {
  const Scene scene = stretchedArm();
  StartState state = atTheScenes(scene);
  letUnrecordedServosHang(scene, {}, state);
  const double shoulder = state.robots[0].positions[0], both = shoulder + state.robots[0].positions[1];
  // Statics: p·(0 − q) + τ = 0; positions turn downwards.
  const double elbowLoad = 0.4 * 9.81 * 0.1 * std::cos(both);
  EXPECT_NEAR(elbowLoad / 5, state.robots[0].positions[1], 1e-3);
  EXPECT_NEAR((elbowLoad + 0.4 * 9.81 * 0.3 * std::cos(shoulder)) / 12, shoulder, 1e-3);
}

TEST(HangingServos, AreWhereAWorldComesToRest) {
  const Scene scene = stretchedArm();
  StartState state = atTheScenes(scene);
  letUnrecordedServosHang(scene, {}, state);
  World world(scene, 1);
  const std::vector<double> still(2, 0.0);
  world.setRobot(0, scene.robots[0].start, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), still, still);
  world.advance({std::vector<JointInput>(2)}, 5);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(world.robot(0).position[j], state.robots[0].positions[j], 1e-3);
}

TEST(HangingServos, ThatWereRecordedAreLeftAlone) {
  const Scene scene = stretchedArm();
  Binding binding;
  binding.measured.push_back({.what = Binding::Measured::What::position, .object = 0, .part = 0, .column = 1});
  binding.inputs.push_back({.robot = 0, .joint = 1, .column = 2});
  StartState state = atTheScenes(scene);
  state.robots[0].positions = {0.3, -0.2};
  letUnrecordedServosHang(scene, binding, state);
  EXPECT_EQ((std::vector<double>{0.3, -0.2}), state.robots[0].positions);
}

TEST(HangingServos, ThatMoveOrAreSwitchedOffDoNotHang) {
  Scene scene = stretchedArm();
  scene.robots[0].drives[1].kind = Drive::Kind::none;
  StartState state = atTheScenes(scene);
  state.robots[0].rates[0] = 0.1;
  letUnrecordedServosHang(scene, {}, state);
  EXPECT_EQ((std::vector<double>{0, 0}), state.robots[0].positions);
}

TEST(HangingServos, StayWhereTheyHangInAReplay) {
  const Scene scene = stretchedArm();
  // Nobody recorded the elbow, and the shoulder is only told where to be.
  Recording recording;
  recording.channels = {"time_s", "arm.shoulder.command_rad"};
  recording.columns = {{}, {}};
  for (int row = 0; row < 100; ++row) {
    recording.columns[0].push_back(0.01 * row);
    recording.columns[1].push_back(0);
  }
  StartState state = atTheScenes(scene);
  letUnrecordedServosHang(scene, {}, state);
  const StartState hung = state;
  Binding binding = bind(scene, recording);
  binding.measured.push_back({.what = Binding::Measured::What::torque, .object = 0, .part = 1, .column = 1});
  const auto replayed = replayRecording(scene, recording, binding, hung);
  const double load = 5 * hung.robots[0].positions[1];
  for (std::size_t row = 10; row < 100; ++row) EXPECT_NEAR(-load, replayed.values[0][row], 0.02 * load);
}

}  // namespace
}  // namespace btr
