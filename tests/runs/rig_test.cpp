// Rigs: scenes that no run belongs to, and the simulators that gap analysis found for them.
#include "core/run/reality/rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/run/reality/adoption.h"
#include "core/spec/json_reader.h"
#include "tests/gap/report/rig_report.h"
#include "tests/plugin/built_plugins.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using test::refusal;
using ::testing::HasSubstr;

class RigTest : public testing::Test {
 protected:
  RigTest() : database_(Database::open(folder_.file("a.db"), Database::Mode::create)) {}
  SimulatorRecord adopt(const std::string& scene) {
    return adoptForRig(database_, host_, scene, files_.simulator, files_.report);
  }
  TemporaryFolder folder_;
  RigReport files_{folder_.file(".")};
  const PluginHost& host_ = test::host();
  Database database_;
  const std::string scene_ = files_.scene;
};

TEST_F(RigTest, IsKnownByItsNumbersAndModelsNotByItsPlace) {
  const Rig here = loadRig(scene_);
  EXPECT_EQ(here.name, "bench");
  std::filesystem::create_directory(folder_.file("elsewhere"));
  folder_.write("elsewhere/leg.urdf", RigReport::urdf);
  EXPECT_EQ(loadRig(folder_.write("elsewhere/bench.json", RigReport::sceneText(4))).spec, here.spec);
  EXPECT_NE(loadRig(folder_.write("other.json", RigReport::sceneText(5))).spec, here.spec);
  std::string heavier = RigReport::urdf;
  heavier.replace(heavier.find("0.2\""), 3, "0.3");
  folder_.write("elsewhere/leg.urdf", heavier);
  EXPECT_NE(loadRig(folder_.file("elsewhere/bench.json")).spec, here.spec);
}

TEST_F(RigTest, TakesWhatWasFoundAsAVersionWithItsEvidence) {
  EXPECT_FALSE(findRig(database_, loadRig(scene_)));
  EXPECT_THAT(refusal([&] { requireRig(database_, scene_); }), HasSubstr("has nothing of this rig"));
  const SimulatorRecord adopted = adopt(scene_);
  EXPECT_EQ(adopted.number, 1);
  EXPECT_EQ(adopted.madeBy, "gap analysis");
  EXPECT_THAT(adopted.evidence, HasSubstr("missing_physics"));
  EXPECT_THAT(adopted.evidence, HasSubstr("report_sha256"));
  const auto all = database_.rigSimulators(requireRig(database_, scene_));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].simulator, SimulatorSpec{});
  EXPECT_EQ(all[1].simulator, loadSimulator(files_.simulator));
  EXPECT_THAT(refusal([&] { adopt(scene_); }), HasSubstr("its version 1 is this simulator already"));
}

TEST_F(RigTest, GoesBackToAnEarlierVersionAsANewOne) {
  const Id rig = adopt(scene_).rig;
  EXPECT_EQ(revertRig(database_, rig).simulator, SimulatorSpec{});
  EXPECT_EQ(revertRig(database_, rig, 1).simulator, loadSimulator(files_.simulator));
  EXPECT_EQ(database_.rigSimulators(rig).size(), 4u);
  EXPECT_EQ(database_.rigSimulators(rig).back().madeBy, "by hand");
  EXPECT_THAT(refusal([&] { revertRig(database_, rig, 9); }),
              HasSubstr("version 9 is not allowed; a version from 0 to 2"));
}

TEST_F(RigTest, RefusesTheReportOfAnotherSceneAndStoresNothing) {
  const std::string other = folder_.write("other.json", RigReport::sceneText(5));
  EXPECT_THAT(refusal([&] { adopt(other); }), HasSubstr("is not the scene of the report"));
  folder_.write("bench.json", RigReport::sceneText(6));
  EXPECT_THAT(refusal([&] { adopt(scene_); }), HasSubstr("or has changed since"));
  EXPECT_TRUE(database_.experiments().empty());
}

TEST_F(RigTest, RefusesWhatItsSceneCannotBuildAndStoresNothing) {
  const std::string file = folder_.write(
      "arm.json", R"({"format": "uchilsim-simulator-1", "values": {"robots.arm.servos.elbow.p": 1}, "effects": []})");
  EXPECT_THAT(refusal([&] { adoptForRig(database_, host_, scene_, file); }),
              HasSubstr("a robot of this scene, which has leg"));
  EXPECT_TRUE(database_.experiments().empty());
}

}  // namespace
}  // namespace btr
