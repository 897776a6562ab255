// Sony's samples, where somebody has them beside the project: unmodified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::HasSubstr;

class Samples : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder())) GTEST_SKIP() << folder() << " is not here";
  }
  static std::string folder() { return SOURCE_DIR "/../shared/openr-samples"; }
  static std::string built(const std::string& sample) {
    const std::string out = emptyFolder("sample_" + sample);
    for (const auto& object : buildOnto(out, {folder() + "/" + sample}).objects)
      EXPECT_EQ(object.modules.size(), 1u) << object.said;
    return out;
  }
  /// As an object of another folder would do it.
  static void motorsOn(int frame, TrivialRobot& robot) {
    OrderFrame on;
    on.motorPower = true;
    if (frame > 1) robot.obey(on);
  }
};

TEST_F(Samples, HelloWorldSaysSo) {
  EXPECT_THAT(runStick(built("HelloWorld"), 5).all(), HasSubstr("helloWorld: !!! Hello World !!!"));
}

TEST_F(Samples, ObjectCommExchanges) {
  const std::string all = runStick(built("ObjectComm"), 5).all();
  EXPECT_THAT(all, HasSubstr("SampleObserver: SampleObserver::Notify() !!! Hello world !!!\n"));
  EXPECT_THAT(all, HasSubstr("SampleObserver: SampleObserver::Notify() !!! Hello world again !!!\n"));
}

TEST_F(Samples, MovingHeadSwingsItsHead) {
  const StickRun run = runStick(built("MovingHead7"), 125 * 20, motorsOn);
  const auto pan = run.targets(robotDesign("ERS-7"), "HEAD_PAN");
  EXPECT_NEAR(*std::max_element(pan.begin(), pan.end()), 1396263, 2000);  // 80°
  EXPECT_NEAR(*std::min_element(pan.begin(), pan.end()), -1396263, 2000);
  EXPECT_EQ(run.ended.why, Ended::Why::shutdown);
}

TEST_F(Samples, MovingLegsLiesDown) {
  const StickRun run = runStick(built("MovingLegs7"), 1000, motorsOn);
  const auto& design = robotDesign("ERS-7");
  const auto front = run.targets(design, "RF_J1"), rear = run.targets(design, "LR_J3");
  ASSERT_FALSE(front.empty());
  EXPECT_NEAR(*std::max_element(front.begin(), front.end()), 2094395, 50000);  // 120°
  EXPECT_NEAR(front.back(), 1029744, 10000);                                   // 59°
  EXPECT_NEAR(rear.back(), 2129302, 10000);                                    // 122°
}

TEST_F(Samples, TheSameBitsEachTime) {
  const std::string stick = built("MovingHead7");
  const auto targets = [&] { return runStick(stick, 500, motorsOn).targets(robotDesign("ERS-7"), "HEAD_PAN"); };
  EXPECT_EQ(targets(), targets());
}

}  // namespace
}  // namespace btr::openr
