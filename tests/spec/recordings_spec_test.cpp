// The blocks "recordings" and "concealed" of an experiment.
#include "core/spec/recordings_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

nlohmann::json kick() { return nlohmann::json::parse(readFile(SOURCE_DIR "/resources/experiments/kick-short.json")); }
ExperimentSpec read(const nlohmann::json& text) { return experimentFromJson(text.dump(), "kick.json", ""); }
std::string complaint(const nlohmann::json& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Recordings, AnExperimentWithoutThemIsWrittenAsBefore) {
  const std::string text = toJsonText(read(kick()));
  EXPECT_THAT(text, Not(HasSubstr("recordings")));
  EXPECT_THAT(text, Not(HasSubstr("concealed")));
  EXPECT_FALSE(read(kick()).recordings.wanted());
}

TEST(Recordings, AreReadBackAsTheyWereWritten) {
  nlohmann::json text = kick();
  text["recordings"] = {{"settings", {{"after_stage", 1}, {"individuals", 3}, {"robot", "on_floor"}}},
                        {"calibrate", {"servo_p_nm_rad"}},
                        {"effects", {"backlash"}},
                        {"joints", {"ers7.LF_J3"}}};
  text["concealed"] = {{"effects", {"backlash"}}, {"at", {"ers7.LF_J3"}}};
  text["stand_in"]["drawn_by"] = "run_seed";
  const ExperimentSpec spec = read(text);
  EXPECT_TRUE(spec.recordings.wanted());
  EXPECT_EQ(spec.recordings.settings.at("robot"), 1);
  EXPECT_EQ(spec.recordings.joints, std::vector<std::string>{"ers7.LF_J3"});
  EXPECT_EQ(spec.concealed.at, std::vector<std::string>{"ers7.LF_J3"});
  EXPECT_EQ(read(nlohmann::json::parse(toJsonText(spec))), spec);
}

TEST(Recordings, InBothPosesHaveASecondListOfNumbersAndEffects) {
  nlohmann::json text = kick();
  text["recordings"] = {{"settings", {{"after_stage", 1}, {"robot", "hung_up_then_on_floor"}}},
                        {"calibrate_on_floor", {"friction"}},
                        {"effects_on_floor", {"contact_compliance"}}};
  const ExperimentSpec spec = read(text);
  EXPECT_EQ(spec.recordings.poses(), (std::vector{RobotPose::hungUp, RobotPose::onFloor}));
  EXPECT_EQ(spec.recordings.calibrateOnFloor, std::vector<std::string>{"friction"});
  EXPECT_EQ(read(nlohmann::json::parse(toJsonText(spec))), spec);
  // In one pose there is one analysis, and nobody would read the second list.
  text["recordings"]["settings"]["robot"] = "on_floor";
  EXPECT_THAT(complaint(text), HasSubstr("hung_up_then_on_floor"));
  text["recordings"].erase("calibrate_on_floor");
  text["recordings"].erase("effects_on_floor");
  EXPECT_EQ(read(text).recordings.poses(), std::vector{RobotPose::onFloor});
}

TEST(Recordings, RefuseWhatNobodyKnows) {
  nlohmann::json text = kick();
  text["recordings"] = {{"calibrate", {"wind"}}};
  EXPECT_THAT(complaint(text), HasSubstr("\"wind\""));
  text["recordings"] = {{"settings", {{"robot", "hung_up_then_on_floor"}}}, {"calibrate_on_floor", {"wind"}}};
  EXPECT_THAT(complaint(text), HasSubstr("\"wind\""));
  text["recordings"] = {{"settings", {{"after_stage", 0.5}}}};
  EXPECT_THAT(complaint(text), HasSubstr("after_stage"));
  text["recordings"] = {{"effects", {"backlash", "backlash"}}};
  EXPECT_THAT(complaint(text), HasSubstr("each once"));
  text["recordings"] = {{"after", 1}};
  EXPECT_THAT(complaint(text), HasSubstr("after"));
  text.erase("recordings");
  text["concealed"] = {{"place", "ers7.LF_J3"}};
  EXPECT_THAT(complaint(text), HasSubstr("place"));
}

}  // namespace
}  // namespace btr
