// A gait for robots that nobody described: what mirrors what, whatever the senses of the axes in their files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/load_model.h"
#include "core/spec/error.h"
#include "tests/plugin/built_plugins.h"
#include "tests/refusal.h"

namespace btr::test::waves {
namespace {

const std::string body = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01'/></inertial>";

std::string link(const std::string& name) { return "<link name='" + name + "'>" + body + "</link>"; }

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& place, const std::string& axis, const std::string& limits = "-1") {
  const std::string upper = limits.substr(1);
  return "<joint name='" + name + "' type='revolute'><parent link='" + parent + "'/><child link='" + child +
         "'/><origin xyz='" + place + "'/><axis xyz='" + axis + "'/><limit lower='" + limits + "' upper='" + upper +
         "'/></joint>";
}

/// Four legs of a roll and a pitch joint at x = ±0.2, y = ±0.1; `right` is the pitch axis in the file of the right
/// ones.
Scene fourLegs(const std::string& right = "0 1 0", const std::string& limits = "-1") {
  std::string text = "<robot name='r'>" + link("trunk");
  for (const auto& [leg, x, y] :
       {std::tuple{"fl", "0.2", "0.1"}, {"fr", "0.2", "-0.1"}, {"rl", "-0.2", "0.1"}, {"rr", "-0.2", "-0.1"}}) {
    const std::string name = leg;
    text += link(name + "1") + link(name + "2") +
            joint(name + "_roll", "trunk", name + "1", std::string(x) + " " + y + " 0", "1 0 0", limits) +
            joint(name + "_pitch", name + "1", name + "2", "0 0 -0.1", name[1] == 'r' ? right : "0 1 0", limits);
  }
  Scene scene;
  scene.floor = FloorSpec{};
  scene.controlPeriod_s = 0.008;
  SceneRobot robot;
  robot.name = "r";
  robot.model = parseUrdf(text + "</robot>", "r.urdf");
  robot.drives.resize(robot.model.joints.size());
  robot.jointStart.assign(robot.model.joints.size(), 0.1);
  scene.robots.push_back(robot);
  return scene;
}

/// Command of each joint by name, some time after the start.
std::map<std::string, double> commandsAt(const Scene& scene, double time_s, const Values& changed) {
  const auto controller = host().controller("limb_waves");
  const auto motion = controller->begin(scene, {}, resolve(controller->genotype(), changed, "test"));
  std::vector<JointInput> inputs(scene.robots[0].model.joints.size());
  RobotReadings readings;
  readings.position = readings.rate = readings.torque = std::vector<double>(inputs.size());
  motion->command(time_s, readings, inputs);
  std::map<std::string, double> commands;
  for (std::size_t j = 0; j < inputs.size(); ++j) commands[scene.robots[0].model.joints[j].name] = inputs[j].command;
  return commands;
}

TEST(LimbWaves, MovesBothSidesAsMirrorImagesWithoutASidePhase) {
  const auto at = commandsAt(fourLegs(), 1.37, {{"side_phase", 0}, {"offset_1_rad", 0.1}});
  EXPECT_DOUBLE_EQ(at.at("fl_pitch"), at.at("fr_pitch")) << "about the lateral axis alike";
  EXPECT_NEAR(at.at("fl_roll") - 0.1, -(at.at("fr_roll") - 0.1), 1e-15) << "about the long axis mirrored";
  EXPECT_GT(std::abs(at.at("fl_roll") - 0.1), 1e-3);
}

TEST(LimbWaves, ASenseOfAnAxisIsTheFilesAffair) {
  const Values gait{{"side_phase", 0.25}};
  const auto plain = commandsAt(fourLegs(), 1.37, gait), turned = commandsAt(fourLegs("0 -1 0"), 1.37, gait);
  EXPECT_NEAR(plain.at("fr_pitch") - 0.1, -(turned.at("fr_pitch") - 0.1), 1e-15);
  EXPECT_DOUBLE_EQ(plain.at("fl_pitch"), turned.at("fl_pitch"));
}

TEST(LimbWaves, IsTheWaveOfItsFormula) {
  const Values gait{{"frequency_hz", 0.8}, {"amplitude_2_rad", 0.4}, {"offset_2_rad", -0.2},
                    {"phase_2", 0.1},      {"rear_phase", 0.3},      {"side_phase", -0.4}};
  const auto at = commandsAt(fourLegs(), 2.0, gait);
  const auto wave = [](double phase) { return 0.1 - 0.2 + 0.4 * std::sin(2 * M_PI * (0.8 * 2.0 + phase)); };
  EXPECT_NEAR(at.at("fl_pitch"), wave(0.1), 1e-12);
  EXPECT_NEAR(at.at("rl_pitch"), wave(0.1 + 0.3), 1e-12);
  EXPECT_NEAR(at.at("rr_pitch"), wave(0.1 + 0.3 - 0.4), 1e-12);
}

TEST(LimbWaves, BeginsWhereTheSceneSaysAndStaysWithinLimits) {
  const Values wide{{"amplitude_1_rad", 0.8}, {"amplitude_2_rad", 0.8}};
  for (const auto& [name, command] : commandsAt(fourLegs(), 0, wide)) EXPECT_EQ(command, 0.1) << name;
  for (double time_s = 1; time_s < 2; time_s += 0.05)
    for (const auto& [name, command] : commandsAt(fourLegs("0 1 0", "-0.3"), time_s, wide))
      EXPECT_LE(std::abs(command), 0.3) << name;
}

TEST(LimbWaves, ARobotWithoutJointsIsRefused) {
  Scene scene = fourLegs();
  scene.robots[0].model = parseUrdf("<robot name='r'>" + link("trunk") + "</robot>", "r.urdf");
  scene.robots[0].drives.clear();
  scene.robots[0].jointStart.clear();
  EXPECT_THAT(refusal([&] { commandsAt(scene, 1, {}); }), testing::HasSubstr("no moving joint"));
}

}  // namespace
}  // namespace btr::test::waves
