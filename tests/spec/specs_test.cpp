// Scenes, simulators and experiments as files: what is written reads back equal, what is wrong is named.
#include <gtest/gtest.h>

#include "core/spec/experiment_spec.h"
#include "core/spec/scene_spec.h"
#include "core/spec/simulator_spec.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using test::refusal;

/// `text` with the first `from` replaced by `to`.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test's own text has no " + from);
  return text.replace(at, from.size(), to);
}

// The contract's example, word by word.
const std::string sceneText = R"({
  "format": "uchilsim-scene-1",
  "gravity_m_s2": [0, 0, -9.81],
  "step_s": 0.001,
  "control_period_s": 0.008,
  "floor": {"friction": 0.8, "restitution": 0.0},
  "robots": [
    {"name": "leg", "model": "leg.urdf", "base": "fixed", "position_m": [0, 0, 0.5],
     "servos": {"knee": {"p": 4.0, "i": 0, "d": 0.03, "max_torque_nm": 1.0}}}
  ],
  "balls": [{"name": "ball", "radius_m": 0.0425, "mass_kg": 0.055, "position_m": [0, 0, 0.0425]}],
  "calibrate": [
    {"path": "robots.leg.servos.knee.p", "min": 2, "max": 8},
    {"path": "robots.leg.links.lower.mass_kg", "min": 0.04, "max": 0.12},
    {"path": "floor.friction", "min": 0.1, "max": 1.5}
  ]
})";

SceneSpec scene(const std::string& text) { return sceneFromJson(text, "s.json", "folder"); }

TEST(Scenes, ReadTheContractsExample) {
  const SceneSpec spec = scene(sceneText);
  ASSERT_EQ(1u, spec.robots.size());
  EXPECT_EQ("fixed", spec.robots[0].base);
  EXPECT_EQ(0.5, spec.robots[0].position_m[2]);
  EXPECT_EQ((Values{{"d", 0.03}, {"i", 0}, {"max_torque_nm", 1}, {"p", 4}}), spec.robots[0].servos.at("knee").numbers);
  ASSERT_TRUE(spec.floor);
  EXPECT_EQ(0.8, spec.floor->friction);
  EXPECT_EQ(3u, spec.calibrate.size());
  EXPECT_EQ("folder", spec.directory);
}

TEST(Scenes, ReadBackEqualWithEveryKeySet) {
  SceneSpec spec = scene(sceneText);
  RobotSpec& robot = spec.robots[0];
  robot.orientation_wxyz = {0.5, -0.5, 0.5, -0.5};
  robot.collision = "mesh";
  robot.mergeFixed = false;
  robot.servos["hip"] = {"dc_motor", {{"firmware_gain_v_per_rad", 1.0 / 3}, {"max_duty", 0.9}}};
  robot.jointStart = {{"knee", 0.1}, {"hip", -1.0 / 7}};
  robot.links["lower"] = {{"mass_kg", 0.07}};
  robot.joints["hip"] = {{"coulomb_friction_nm", 0.02}, {"viscous_friction_nm_s_rad", 0.001}};
  spec.balls.push_back({"second", 0.04, 0.06, 0.4, 0.5, 0.3, {1, 2, 0.04}, {0.1, 0, 0}});
  spec.floor = FloorSpec{0.9, 0.1, 0.01, 0.02, 3e4, 120};
  spec.robots.push_back(robot);
  RobotSpec& thrown = spec.robots.back();
  thrown.name = "thrown";
  thrown.base = "free";
  thrown.velocity_m_s = {1, -2, 1.0 / 3};
  thrown.spin_rad_s = {0, 0, 6};
  thrown.jointRate = {{"knee", -1.0 / 7}};
  EXPECT_EQ(spec, scene(toJsonText(spec)));
}

TEST(Scenes, SayNothingOfRobotsAtRest) {
  const std::string text = toJsonText(scene(sceneText).robots[0]);
  for (const char* key : {"velocity_m_s", "spin_rad_s", "joint_velocity"})
    EXPECT_EQ(text.find(key), std::string::npos) << key;
}

TEST(Scenes, WithoutAFloorThereIsNothingToStandOn) {
  EXPECT_FALSE(scene(with(sceneText, R"("floor": {"friction": 0.8, "restitution": 0.0},)", "")).floor);
}

TEST(Scenes, ABallWithoutAPlaceLiesOnTheFloor) {
  EXPECT_EQ(
      0.05,
      scene(R"({"format": "uchilsim-scene-1", "balls": [{"name": "b", "radius_m": 0.05}]})").balls[0].position_m[2]);
}

TEST(Scenes, ATypedQuaternionIsMadeExactlyUnit) {
  const auto q =
      scene(with(sceneText, R"("base": "fixed",)", R"("base": "fixed", "orientation_wxyz": [0.7071, 0.7071, 0, 0],)"))
          .robots[0]
          .orientation_wxyz;
  EXPECT_NEAR(1, q[0] * q[0] + q[1] * q[1], 1e-15);
}

TEST(Scenes, NameWhatIsWrong) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal([&] { scene(with(sceneText, from, to)); });
  };
  EXPECT_EQ("s.json /format: \"uchilsim-scene-9\" is not allowed; one of uchilsim-scene-1",
            refused("uchilsim-scene-1", "uchilsim-scene-9"));
  EXPECT_EQ("s.json /step_s: 0.003 is not allowed; a whole part of control_period_s = 0.008",
            refused("0.001", "0.003"));
  EXPECT_EQ("s.json /step_s: 1e-07 is not allowed; 1e-05 to 0.02", refused("0.001", "1e-7"));
  const std::string gain = refused("\"p\": 4.0", "\"kp\": 4.0");
  EXPECT_TRUE(gain.starts_with("s.json /robots/0/servos/knee: key \"kp\" is not known; known keys: ")) << gain;
  for (const char* known : {" d,", " drive,", " i,", " max_torque_nm,", " p,"})
    EXPECT_NE(std::string::npos, gain.find(known)) << known << gain;  // those that this file does not use, too
  EXPECT_EQ("s.json /balls/0/name: \"leg\" is not allowed; a name that no other robot, ball or obstacle has",
            refused("\"name\": \"ball\"", "\"name\": \"leg\""));
  EXPECT_NE("accepted", refused("\"name\": \"ball\"", "\"name\": \"my.ball\""));
  EXPECT_EQ("s.json /balls/0/radius_m: -1 is not allowed; 0.001 to 10", refused("0.0425, \"mass", "-1, \"mass"));
  EXPECT_EQ("s.json /gravity_m_s2: [0,0,-981.0] is not allowed; numbers from -100 to 100", refused("-9.81", "-981.0"));
  EXPECT_EQ("s.json /calibrate/0/max: 2 is not allowed; a number above min", refused("\"max\": 8", "\"max\": 2"));
  EXPECT_EQ("s.json /robots/0/velocity_m_s: [1,0,0] is not allowed; nothing for a robot whose base is fixed",
            refused("\"base\": \"fixed\"", "\"base\": \"fixed\", \"velocity_m_s\": [1, 0, 0]"));
  EXPECT_EQ("s.json /robots/0/velocity_m_s: [0,0,51] is not allowed; numbers from -50 to 50",
            refused("\"base\": \"fixed\"", "\"velocity_m_s\": [0, 0, 51]"));
  EXPECT_EQ(
      "s.json /robots/0/joint_velocity: {\"knee\":501} is not allowed; velocities from -500 to 500 rad/s, from -50 "
      "to 50 m/s of a slide joint",
      refused("\"base\": \"fixed\"", "\"joint_velocity\": {\"knee\": 501}"));
  EXPECT_EQ("s.json /robots/0/model: 3 is not allowed; a text \"…\"", refused("\"leg.urdf\"", "3"));
}

TEST(Simulators, ReadBackEqual) {
  SimulatorSpec simulator{{{"leg_mass_kg", 0.21}, {"robots.leg.servos.knee.p", 3.71}},
                          {{"backlash", "leg.knee", {{"width_rad", 0.051}}}}};
  EXPECT_EQ(simulator, simulatorFromJson(toJsonText(simulator), "m.json"));
}

TEST(Simulators, KeepTheirParametersInTheirRange) {
  const std::string text = R"({"format": "uchilsim-simulator-1", "values": {"leg_mass_kg": 3}})";
  EXPECT_EQ("m.json /values/leg_mass_kg: 3 is not allowed; 0.12 to 0.3 kg",
            refusal([&] { simulatorFromJson(text, "m.json"); }));
}

TEST(Simulators, HaveTwelveParametersOfTheSeed) {
  EXPECT_EQ(12u, simulatorParameters().size());
  for (const Parameter& parameter : simulatorParameters()) {
    EXPECT_LT(parameter.minimum, parameter.maximum) << parameter.name;
    EXPECT_NO_THROW(check(parameter, parameter.byDefault, parameter.name));
  }
}

const std::string experimentText = R"({
  "format": "uchilsim-experiment-1", "name": "Kick", "scene": "kick_scene.json",
  "controller": {"name": "kick", "settings": {"distance_m": 0.16}},
  "fitness": {"name": "kick_distance", "settings": {"measured_from": "neck"}},
  "learner": {"name": "ga", "settings": {"population": 30, "coding": "gray"}},
  "start": {"parameters": {"points": 6}, "share": 0.8, "flip": 0.02},
  "stages": {"first_generations": 50, "hide_simulated": "no"},
  "adaptation": {"learner": {"name": "ga"}, "settings": {"generations": 10, "norm": "maximum", "held_out": 2},
                 "parameters": ["friction", "leg_mass_kg"]},
  "simulator": {"values": {"friction": 0.9}, "effects": [{"effect": "backlash", "at": "ers7.LF_J3", "parameters": {}}]},
  "reality": "stand_in", "stand_in": {"seed": 5}, "seed": 18446744073709551615
})";

ExperimentSpec experiment(const std::string& text) { return experimentFromJson(text, "e.json", "folder"); }

TEST(Experiments, ReadBackEqual) {
  const ExperimentSpec spec = experiment(experimentText);
  EXPECT_EQ(18446744073709551615u, spec.seed);
  EXPECT_EQ(2, spec.adaptationSettings.at("norm"));
  EXPECT_EQ("gray", spec.learner.words.at("coding"));
  ASSERT_TRUE(spec.start);
  EXPECT_EQ((SearchStart{{{"points", 6}}, 0.8, 0.02}), *spec.start);
  EXPECT_EQ(spec, experiment(toJsonText(spec)));
}

TEST(Experiments, HaveTheSeedsCadenceByDefault) {
  const auto byDefault = [](const std::string& name) { return valueOf(stageParameters(), {}, name); };
  EXPECT_EQ(50, byDefault("first_generations"));
  EXPECT_EQ(100, byDefault("next_generations"));
  EXPECT_EQ(500, byDefault("total_generations"));
  EXPECT_EQ(10, byDefault("measured_individuals"));
  EXPECT_EQ(10, valueOf(adaptationParameters(), {}, "generations"));
}

TEST(Experiments, KeepARealityWithSettingsAndFoldersOfPlugins) {
  const ExperimentSpec spec = experiment(with(
      experimentText, "\"stand_in\",",
      R"({"name": "program", "settings": {"program": "../robot.sh", "timeout_s": 5}}, "plugins": ["build/plugins"],)"));
  EXPECT_EQ("program", spec.reality);
  EXPECT_EQ("../robot.sh", spec.realityOptions.words.at("program"));
  EXPECT_EQ(5, spec.realityOptions.settings.at("timeout_s"));
  EXPECT_EQ(std::vector<std::string>{"build/plugins"}, spec.plugins);
  EXPECT_EQ(spec, experiment(toJsonText(spec)));
}

TEST(Experiments, NameWhatIsWrong) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal([&] { experiment(with(experimentText, from, to)); });
  };
  EXPECT_EQ("e.json /stages/first_generations: 0 is not allowed; whole numbers 1 to 1000000",
            refused("\"first_generations\": 50", "\"first_generations\": 0"));
  EXPECT_EQ(
      "e.json /adaptation/settings/norm: \"median\" is not allowed; one of mean_absolute, root_mean_square, maximum",
      refused("\"maximum\"", "\"median\""));
  EXPECT_EQ("e.json /adaptation/settings/held_out: 10 is not allowed; less than measured_individuals = 10",
            refused("\"held_out\": 2", "\"held_out\": 10"));
  EXPECT_NE("accepted", refused("\"stand_in\",", "7,"));
  EXPECT_NE("accepted", refused("\"stand_in\",", "\"\","));
  EXPECT_EQ("e.json /start/share: 1.8 is not allowed; 0 to 1", refused("\"share\": 0.8", "\"share\": 1.8"));
  EXPECT_NE("accepted", refused("\"flip\"", "\"flips\""));
  EXPECT_NE("accepted", refused("\"leg_mass_kg\"", "\"friction\""));
  EXPECT_NE("accepted", refused("\"leg_mass_kg\"", "\"ear_mass_kg\""));
  EXPECT_NE("accepted", refused("\"seed\": 18446744073709551615", "\"seed\": 18446744073709551616"));
}

TEST(PluginChoices, WordsBecomeNumbersOnceThePluginIsKnown) {
  const std::vector<Parameter> declared{{"population", "", "", 2, 99, 30, {}, true},
                                        {"coding", "", "", 0, 1, 0, {}, false, {"binary", "gray"}}};
  const PluginChoice choice = experiment(experimentText).learner;
  const Values values = settingsOf(choice, declared, "e.json /learner/settings");
  EXPECT_EQ((Values{{"coding", 1}, {"population", 30}}), values);
  EXPECT_EQ(choice, choiceOf("ga", values, declared));

  const auto refused = [&](const PluginChoice& wrong) {
    return refusal([&] { settingsOf(wrong, declared, "e.json /learner/settings"); });
  };
  EXPECT_EQ("e.json /learner/settings/coding: \"grey\" is not allowed; one of binary, gray",
            refused({"ga", {}, {{"coding", "grey"}}}));
  EXPECT_EQ("e.json /learner/settings/population: \"many\" is not allowed; a number",
            refused({"ga", {}, {{"population", "many"}}}));
  EXPECT_EQ("e.json /learner/settings: \"colour\" is not allowed; known names: population, coding",
            refused({"ga", {}, {{"colour", "red"}}}));
  EXPECT_EQ("e.json /learner/settings/population: 1 is not allowed; whole numbers 2 to 99",
            refused({"ga", {{"population", 1}}, {}}));
}

}  // namespace
}  // namespace btr
