// An OPEN-R program in a trial: its parameters, its own copy of the stick, what it moves, its end.
#include "core/openr/trial_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>

#include "core/sim/trial.h"
#include "core/spec/json_reader.h"
#include "tests/openr_live/played_program.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using openr::OrderFrame;
using openr::SensorFrame;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// Makes TrialMotions with a program that a test plays; the folder of its stick is told.
class Played final : public Controller {
 public:
  Played(std::string stick, Answer answer) : stick_(std::move(stick)), answer_(std::move(answer)) {}
  std::vector<Parameter> genotype() const override { return openr::stickParameters(stick_); }
  std::vector<Parameter> settings() const override { return {}; }
  void arrange(Scene&, const Values&) const override {}
  std::unique_ptr<Motion> begin(const Scene& scene, const Values&, std::span<const double> parameters) const override {
    const std::string text = openr::parametersText(genotype(), parameters);
    return std::make_unique<openr::TrialMotion>(
        scene, openr::TrialMotion::Task{stick_, text, 2, true},
        [this](const std::string& folder, const openr::RobotDesign&) -> std::unique_ptr<openr::RunningProgram> {
          folder_ = folder;
          parameters_ = readFile(folder + "/PARAMS.TXT");
          return std::make_unique<PlayedProgram>(answer_);
        });
  }
  mutable std::string folder_, parameters_;

 private:
  std::string stick_;
  Answer answer_;
};

class OpenrTrial : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(stick_ + "/OPEN-R/MW");
    writeFile(stick_ + "/OPEN-R/MW/DATA.TXT", "data");
    writeParameters(R"({"name": "pan_p", "min": 1, "max": 64, "default": 8, "integer": true},
                       {"name": "ahead_ms", "unit": "ms", "meaning": "m", "min": -50, "max": 250, "default": 0})");
  }
  void writeParameters(const std::string& list) const {
    writeFile(stick_ + "/parameters.json",
              R"({"format": "uchilsim-openr-parameters-1", "parameters": [)" + list + "]}");
  }
  std::string why(const std::string& list) const {
    writeParameters(list);
    return refusal([&] { openr::stickParameters(stick_); });
  }
  static Scene scene() {
    const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/head.json");
    return makeScene(spec, loadModels(spec), {}, host().effectFactory());
  }
  static double last(const TrialResult& result, const std::string& channel) {
    return result.trace.at(result.trace.rows() - 1, static_cast<std::size_t>(result.trace.column(channel)));
  }
  static TrialResult run(const Played& controller, std::vector<double> parameters = {8, 0}) {
    TrialOptions options;
    options.recordTrace = true;
    return runTrial(scene(), controller, {}, parameters, 1, options);
  }

  const TemporaryFolder temporary_;
  const std::string stick_ = temporary_.file("trial-stick");
};

TEST_F(OpenrTrial, ParametersAreNamedInTheSticksFile) {
  const std::vector<Parameter> parameters = openr::stickParameters(stick_);
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters[0].name, "pan_p");
  EXPECT_TRUE(parameters[0].integer);
  EXPECT_EQ(parameters[0].byDefault, 8);
  EXPECT_EQ(parameters[1].unit, "ms");
  EXPECT_EQ(parameters[1].minimum, -50);
  EXPECT_EQ(openr::parametersText(parameters, std::vector<double>{12, 0.1}), "pan_p 12\nahead_ms 0.1\n");
}

TEST_F(OpenrTrial, WhatIsWrongInTheFileIsSaidInOneSentence) {
  EXPECT_THAT(why(R"({"name": "a b", "min": 0, "max": 1, "default": 0})"), HasSubstr("name"));
  EXPECT_THAT(why(R"({"name": "a", "min": 1, "max": 1, "default": 1})"), HasSubstr("max"));
  EXPECT_THAT(why(R"({"name": "a", "min": 0, "max": 1, "default": 2})"), HasSubstr("default"));
  EXPECT_THAT(why(R"({"name": "a", "min": 0, "max": 1, "default": 1, "minimum": 3})"), HasSubstr("minimum"));
  EXPECT_THAT(
      why(R"({"name": "a", "min": 0, "max": 1, "default": 1}, {"name": "a", "min": 0, "max": 1, "default": 1})"),
      HasSubstr("once"));
  EXPECT_THAT(why(""), HasSubstr("parameters"));
  fs::remove(stick_ + "/parameters.json");
  EXPECT_THAT(refusal([&] { openr::stickParameters(stick_); }), HasSubstr("parameters.json"));
}

TEST_F(OpenrTrial, EveryTrialHasAStickOfItsOwnThatGoesAway) {
  const Played controller(stick_, [](const SensorFrame&) { return OrderFrame{}; });
  run(controller, {17, 12.5});
  EXPECT_EQ(controller.parameters_, "pan_p 17\nahead_ms 12.5\n");
  EXPECT_NE(controller.folder_, stick_);
  EXPECT_FALSE(fs::exists(controller.folder_));
  EXPECT_FALSE(fs::exists(stick_ + "/PARAMS.TXT"));
  EXPECT_EQ(readFile(stick_ + "/OPEN-R/MW/DATA.TXT"), "data");
}

/// Copies a stick in a process that is killed then; the copy's folder.
std::string copiedAndKilled(const openr::StickShelf& shelf, const std::string& stick) {
  int line[2];
  EXPECT_EQ(0, pipe(line));
  const pid_t worker = fork();
  if (worker == 0) {
    const openr::PrivateStick copy(shelf, stick, "");
    [[maybe_unused]] const ssize_t n = write(line[1], copy.folder().data(), copy.folder().size());
    close(line[1]);
    raise(SIGKILL);
  }
  close(line[1]);
  std::string folder(4096, '\0');
  folder.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(line[0], folder.data(), folder.size()))));
  close(line[0]);
  int status = 0;
  waitpid(worker, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  return folder;
}

TEST_F(OpenrTrial, AKilledWorkersStickGoesWithTheNextTrialOrTheExperiment) {
  std::string first, second, shelfFolder;
  {
    const openr::StickShelf shelf;
    shelfFolder = shelf.folder();
    first = copiedAndKilled(shelf, stick_);
    EXPECT_TRUE(fs::exists(first + "/OPEN-R/MW/DATA.TXT"));
    second = copiedAndKilled(shelf, stick_);
    EXPECT_FALSE(fs::exists(first));
    EXPECT_TRUE(fs::exists(second));
  }
  EXPECT_FALSE(fs::exists(shelfFolder));
}

TEST_F(OpenrTrial, TheSticksOfAKilledExperimentGoWhenTheNextOneBegins) {
  const TemporaryFolder temporary;
  const char* before = getenv("TMPDIR");
  const std::string old = before ? before : "";
  setenv("TMPDIR", temporary.path().c_str(), 1);
  const pid_t owner = fork();
  if (owner == 0) {
    const openr::StickShelf shelf;
    const openr::PrivateStick copy(shelf, stick_, "");
    raise(SIGKILL);
  }
  waitpid(owner, nullptr, 0);
  const auto entries = [&] {
    return std::distance(fs::directory_iterator(temporary.path()), fs::directory_iterator());
  };
  EXPECT_EQ(1, entries());
  {
    const openr::StickShelf living;  // and is not taken for an abandoned one by the next
    const openr::PrivateStick copy(living, stick_, "");
    const openr::StickShelf another;
    EXPECT_EQ(2, entries());
    EXPECT_TRUE(fs::exists(copy.folder() + "/OPEN-R/MW/DATA.TXT"));
  }
  EXPECT_EQ(0, entries());
  before ? setenv("TMPDIR", old.c_str(), 1) : unsetenv("TMPDIR");
}

TEST_F(OpenrTrial, AProgramMovesTheJointsThatItEnables) {
  SensorFrame seen;
  const Played controller(stick_, [&](const SensorFrame& frame) {
    seen = frame;
    OrderFrame orders = orderOf("HEAD_PAN", {600000});
    orders.joints[placeOf("NECK_TILT")].target_urad = -100000;
    if (frame.number == 1) orders.joints[placeOf("HEAD_PAN")].gainEnabled = true;
    return orders;
  });
  const TrialResult result = run(controller);
  EXPECT_EQ(result.outcome, TrialResult::Outcome::finished);
  EXPECT_NEAR(last(result, "ers7.HEAD_PAN.position_rad"), 0.6, 0.01);
  EXPECT_NEAR(seen.joints[placeOf("HEAD_PAN")].value_urad, 600000, 10000);
  EXPECT_EQ(seen.number, 250u);
  // Nobody enabled the neck: it hangs.
  EXPECT_LT(last(result, "ers7.NECK_TILT.position_rad"), -0.5);
}

TEST_F(OpenrTrial, TheSameTrialHasTheSameBits) {
  const auto turns = [](const SensorFrame& frame) {
    OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
    orders.joints.resize(openr::robotDesign("ERS-7").joints.size());
    // Follows what it senses, so that a bit more or less anywhere would grow.
    orders.joints[placeOf("HEAD_PAN")].target_urad = 700000 - frame.joints[placeOf("NECK_TILT")].value_urad / 3;
    return orders;
  };
  EXPECT_EQ(run(Played(stick_, turns)).trace.sha256(), run(Played(stick_, turns)).trace.sha256());
}

TEST_F(OpenrTrial, ACrashIsAFailureOfTheTrialThatNamesObjectAndMethod) {
  const Played controller(stick_, [](const SensorFrame& frame) {
    OrderFrame orders;
    if (frame.number == 20) orders.ended = openr::Ended{openr::Ended::Why::endlessLoop, "Loops", "Ready0", ""};
    return orders;
  });
  EXPECT_THAT(refusal([&] { run(controller); }), HasSubstr("Loops did not come back in Ready0"));
  EXPECT_FALSE(fs::exists(controller.folder_));
}

TEST_F(OpenrTrial, ARobotThatIsShutDownIsLimpToTheEnd) {
  const Played controller(stick_, [](const SensorFrame& frame) {
    OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
    EXPECT_LE(frame.number, 20u);
    if (frame.number == 20) orders.ended = openr::Ended{openr::Ended::Why::shutdown, "Monitor", "", ""};
    return orders;
  });
  const TrialResult result = run(controller);
  EXPECT_EQ(result.outcome, TrialResult::Outcome::finished);
  EXPECT_LT(last(result, "ers7.NECK_TILT.position_rad"), -0.5);
}

TEST_F(OpenrTrial, ASceneOfAnotherPeriodIsRefused) {
  Scene other = scene();
  other.controlPeriod_s = 0.01;
  EXPECT_THAT(refusal([&] { openr::TrialMotion(other, {}, {}); }), HasSubstr("0.008"));
}

}  // namespace
}  // namespace btr::test
