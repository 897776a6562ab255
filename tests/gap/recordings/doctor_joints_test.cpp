// The doctor's look at commands and measured positions: recordings made by the simulator, spoiled as mappings spoil
// them, and recordings that nothing is wrong with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/start_state.h"
#include "core/spec/random.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

// A shoulder and an elbow with limits, hanging on a wall, and a sliding gripper.
constexpr const char* armUrdf = R"(<robot name="arm">
  <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="wall"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-1.6" upper="1.6" effort="5" velocity="10"/></joint>
  <link name="upper"><inertial><origin xyz="0 0 -0.1"/><mass value="0.2"/>
    <inertia ixx="4e-4" iyy="4e-4" izz="4e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="elbow" type="revolute"><origin xyz="0 0 -0.2"/><parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/>
    <limit lower="-0.4" upper="2.1" effort="5" velocity="10"/></joint>
  <link name="lower"><inertial><origin xyz="0 0 -0.08"/><mass value="0.1"/>
    <inertia ixx="2e-4" iyy="2e-4" izz="2e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="gripper" type="prismatic"><parent link="lower"/><child link="finger"/><axis xyz="1 0 0"/>
    <limit lower="-0.1" upper="0.1" effort="20" velocity="1"/></joint>
  <link name="finger"><inertial><mass value="0.02"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>)";

std::vector<std::string> textsOf(const std::vector<Finding>& findings) {
  std::vector<std::string> texts;
  for (const Finding& finding : findings) texts.push_back(finding.text);
  return texts;
}

struct Arm {
  Scene scene;
  Recording recording;
  std::vector<double>& column(const std::string& name) {
    return recording.columns[static_cast<std::size_t>(recording.column(name))];
  }
  void change(const std::string& name, double scale, double offset = 0) {
    for (double& value : column(name)) value = scale * value + offset;
  }
  std::vector<Finding> found() const { return doctor(scene, recording, bind(scene, recording)).findings; }
  std::vector<std::string> findings() const { return textsOf(found()); }
};

// Twelve seconds of slow, different motions, as the simulator itself would log them with a noise of 2 mrad.
Arm arm(double gain = 12) {
  const TemporaryFolder folder;
  folder.write("arm.urdf", armUrdf);
  const std::string p = std::to_string(gain);
  const SceneSpec spec = sceneFromJson(
      R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.008, "robots": [
        {"name": "arm", "model": "arm.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none", "servos": {
          "shoulder": {"p": )" +
          p + R"(, "d": 0.1, "max_torque_nm": 3}, "elbow": {"p": )" + p +
          R"(, "d": 0.05, "max_torque_nm": 3}, "gripper": {"p": 200, "d": 4, "max_force_n": 20}}}]})",
      "scene", folder.file("."));
  Arm made{makeScene(spec, loadModels(spec), {}, {}), {}};
  made.recording.source = "arm.csv";
  made.recording.channels = {"time_s",
                             "arm.shoulder.command_rad",
                             "arm.shoulder.position_rad",
                             "arm.elbow.command_rad",
                             "arm.elbow.position_rad",
                             "arm.gripper.command_m",
                             "arm.gripper.position_m"};
  made.recording.columns.resize(7);
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.008 * i;
    const double row[] = {
        t,   0.6 * std::sin(2 * t + 0.1 * t * t), 0, 0.6 + 0.5 * std::sin(3.1 * t) + 0.2 * std::sin(0.7 * t),
        0.6, 0.05 * std::sin(1.7 * t + 0.9),      0};
    for (std::size_t c = 0; c < 7; ++c) made.recording.columns[c].push_back(row[c]);
  }
  const Binding binding = bind(made.scene, made.recording);
  const ReplayedRecording replayed =
      replayRecording(made.scene, made.recording, binding, startState(made.scene, made.recording, binding));
  Random random(7);
  for (std::size_t i = 0; i < binding.measured.size(); ++i) {
    auto& column = made.recording.columns[binding.measured[i].column];
    column = replayed.values[i];
    const bool slides = made.recording.channels[binding.measured[i].column].ends_with("_m");
    for (double& value : column) value += (slides ? 0.0002 : 0.002) * random.normal();
  }
  return made;
}

TEST(JointDoctor, FindsNothingInASimulatedRecordingHoweverSoftTheServo) {
  for (const double gain : {3.0, 12.0, 60.0}) EXPECT_THAT(arm(gain).findings(), IsEmpty()) << gain;
}

TEST(JointDoctor, TellsDegreesFromRadiansInEitherColumn) {
  Arm position = arm();
  position.change("arm.elbow.position_rad", 180 / M_PI);
  EXPECT_THAT(position.findings(),
              ElementsAre(AllOf(HasSubstr("arm.elbow.position_rad moves 5"), HasSubstr("(correlation "),
                                HasSubstr("arm.elbow.position_rad is in degrees, not radians"),
                                HasSubstr("multiply its \"scale\" in the mapping by 0.0174533"))));
  Arm command = arm();
  command.change("arm.elbow.command_rad", 180 / M_PI);
  EXPECT_THAT(command.findings(),
              ElementsAre(AllOf(HasSubstr("arm.elbow.command_rad is in degrees"), HasSubstr("by 0.0174533"))));
  Arm twice = arm();
  twice.change("arm.shoulder.position_rad", M_PI / 180);
  EXPECT_THAT(twice.findings(),
              ElementsAre(AllOf(HasSubstr("position_rad is radians taken for degrees"), HasSubstr("by 57.2958"))));
  Arm both = arm();
  both.change("arm.shoulder.position_rad", 180 / M_PI);
  both.change("arm.shoulder.command_rad", 180 / M_PI);
  EXPECT_THAT(both.findings(), ElementsAre(AllOf(HasSubstr("both are in degrees"), HasSubstr("1.6 rad at most"))));
}

TEST(JointDoctor, IsCertainOnlyWhereNoPhysicsDoesThat) {
  const auto isCertain = [](const Arm& made) {
    const auto found = made.found();
    EXPECT_EQ(found.size(), 1u);
    return !found.empty() && found[0].certain;
  };
  Arm degrees = arm();
  degrees.change("arm.shoulder.position_rad", 180 / M_PI);
  EXPECT_TRUE(isCertain(degrees));
  Arm turned = arm();
  turned.change("arm.shoulder.position_rad", -1);
  EXPECT_TRUE(isCertain(turned));
  Arm mixed = arm();
  std::swap(mixed.column("arm.shoulder.position_rad"), mixed.column("arm.elbow.position_rad"));
  EXPECT_TRUE(isCertain(mixed));
  Arm slow = arm();
  for (double& time : slow.recording.columns[0]) time *= 1000;
  EXPECT_TRUE(isCertain(slow));
  // A joint that friction holds stands still or hardly moves, and a sensor may be off.
  Arm still = arm();
  still.change("arm.elbow.position_rad", 0, 0.6);
  EXPECT_FALSE(isCertain(still));
  Arm held = arm();
  held.change("arm.shoulder.position_rad", M_PI / 180);
  EXPECT_FALSE(isCertain(held));
  Arm off = arm();
  off.change("arm.elbow.position_rad", 1, 0.3);
  EXPECT_FALSE(isCertain(off));
}

TEST(JointDoctor, FindsAMeasurementThatIsAheadOfItsCommand) {
  for (const std::size_t rows : {25u, 40u}) {
    Arm made = arm();
    auto& position = made.column("arm.shoulder.position_rad");
    std::rotate(position.begin(), position.begin() + static_cast<std::ptrdiff_t>(rows), position.end());
    made.recording.columns[0].resize(position.size() - rows);
    for (auto& column : made.recording.columns) column.resize(made.recording.rows());
    EXPECT_THAT(made.findings(),
                testing::Contains(AllOf(HasSubstr("arm.shoulder.position_rad moves 0."),
                                        HasSubstr(" s before arm.shoulder.command_rad does"), HasSubstr("clocks"))))
        << rows;
  }
}

TEST(JointDoctor, SaysNothingOfAColumnWithoutNumbers) {
  Arm made = arm();
  made.change("arm.elbow.position_rad", std::nan(""));
  EXPECT_THAT(made.findings(), IsEmpty());
}

TEST(JointDoctor, TellsMillimetresFromMetres) {
  Arm made = arm();
  made.change("arm.gripper.position_m", 1000);
  EXPECT_THAT(made.findings(), ElementsAre(AllOf(HasSubstr("arm.gripper.position_m is in millimetres, not metres"),
                                                 HasSubstr("by 0.001"))));
  Arm centimetres = arm();
  centimetres.change("arm.gripper.command_m", 100);
  EXPECT_THAT(centimetres.findings(), ElementsAre(HasSubstr("arm.gripper.command_m is in centimetres")));
}

TEST(JointDoctor, FindsATurnedSign) {
  Arm made = arm();
  made.change("arm.shoulder.position_rad", -1);
  EXPECT_THAT(made.findings(), ElementsAre(AllOf(HasSubstr("arm.shoulder.position_rad moves against "),
                                                 HasSubstr("(correlation -"), HasSubstr("negative \"scale\""))));
  made.change("arm.shoulder.position_rad", 180 / M_PI);
  EXPECT_THAT(made.findings(), ElementsAre(HasSubstr("is in degrees"), HasSubstr("moves against")));
}

TEST(JointDoctor, FindsJointsThatWereMixedUp) {
  Arm made = arm();
  std::swap(made.column("arm.shoulder.position_rad"), made.column("arm.elbow.position_rad"));
  EXPECT_THAT(made.findings(), ElementsAre(AllOf(HasSubstr("arm.shoulder.position_rad follows arm.elbow.command_rad"),
                                                 HasSubstr("arm.elbow.position_rad follows arm.shoulder.command_rad"),
                                                 HasSubstr("exchange the two columns"))));
  // Joints that move alike cannot be told apart: no claim.
  Arm alike = arm();
  alike.scene.robots[0].model.joints[1].lower = -1.6;
  alike.column("arm.elbow.command_rad") = alike.column("arm.shoulder.command_rad");
  alike.column("arm.elbow.position_rad") = alike.column("arm.shoulder.position_rad");
  EXPECT_THAT(alike.findings(), IsEmpty());
}

TEST(JointDoctor, FindsAnOffsetThatTheLoadDoesNotExplain) {
  for (const double offset : {0.12, -0.3}) {
    Arm made = arm();
    made.change("arm.elbow.position_rad", 1, offset);
    const auto findings = made.findings();
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_THAT(findings[0], AllOf(HasSubstr("arm.elbow.position_rad lies "), HasSubstr("an offset of the encoder"),
                                   HasSubstr(offset > 0 ? " above " : " below ")));
    const std::size_t at = findings[0].find("add ");
    EXPECT_NEAR(std::stod(findings[0].substr(at + 4)), -offset, 0.02);
  }
}

TEST(JointDoctor, FindsAColumnThatStandsStillAndMilliseconds) {
  Arm made = arm();
  made.change("arm.elbow.position_rad", 0, 0.6);
  EXPECT_THAT(made.findings(), ElementsAre(HasSubstr("arm.elbow.position_rad is always 0.6 rad while")));
  Arm slow = arm();
  for (double& time : slow.recording.columns[0]) time *= 1000;
  EXPECT_THAT(slow.findings(), testing::Contains(AllOf(HasSubstr("time_s"), HasSubstr("milliseconds"))));
}

// The simulated joint stops there; what the recording does beyond was analysed as missing physics.
TEST(JointDoctor, FindsPositionsThatTheModelsJointCannotHave) {
  Arm a = arm();
  Joint& elbow = a.scene.robots[0].model.joints[1];
  ASSERT_EQ("elbow", elbow.name);
  const std::vector<double>& column = a.column("arm.elbow.position_rad");
  const double highest = *std::ranges::max_element(column);
  elbow.upper = highest - 0.2;
  EXPECT_THAT(a.findings(),
              ElementsAre(AllOf(HasSubstr("arm.elbow.position_rad goes to "),
                                HasSubstr(", past the joint's upper limit of "), HasSubstr("in the model"))));
  elbow.upper = highest - 0.02;  // a stop that gives
  EXPECT_THAT(a.findings(), IsEmpty());
}

TEST(JointDoctor, SaysNothingWhereNothingMovesEnough) {
  Arm made = arm();
  made.change("arm.shoulder.command_rad", 0.01);
  made.change("arm.shoulder.position_rad", -0.01);
  EXPECT_THAT(made.findings(), IsEmpty());
}

TEST(JointDoctor, ReachesTheResidualsNotes) {
  Arm made = arm();
  made.change("arm.shoulder.position_rad", -1);
  EXPECT_THAT(residual(made.scene, {made.recording}).notes, testing::Contains(HasSubstr("a sign is turned")));
}

TEST(JointDoctor, FindsNothingInTheXl330Recordings) {
  const char* given = std::getenv("UCHILSIM_RECORDINGS");
  const fs::path folder = fs::path(given ? given : SOURCE_DIR "/../shared/recordings") / "bam_xl330" / "csv";
  const fs::path own = SOURCE_DIR "/tests/data/bam_xl330";
  const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/xl330.json");
  const Scene scene = makeScene(spec, loadModels(spec), {}, {});
  const Mapping mapping = loadMapping(SOURCE_DIR "/resources/scenes/xl330.mapping.json");
  int logs = 0;
  for (const auto& entry : fs::directory_iterator(fs::is_directory(folder) ? folder : own)) {
    if (entry.path().extension() != ".csv") continue;
    Recording recording = loadRecording(entry.path().string(), &mapping);
    EXPECT_THAT(textsOf(doctor(scene, recording, bind(scene, recording)).findings), IsEmpty()) << entry.path();
    // The same log with a turned sign or in degrees is found out, unless its motion is too fast to tell.
    auto& position = recording.columns[static_cast<std::size_t>(recording.column("xl330.shoulder.position_rad"))];
    for (double& value : position) value *= 180 / M_PI;
    EXPECT_THAT(textsOf(doctor(scene, recording, bind(scene, recording)).findings),
                ElementsAre(HasSubstr("is in degrees")))
        << entry.path();
    ++logs;
  }
  EXPECT_GE(logs, 2);
}

}  // namespace
}  // namespace btr
