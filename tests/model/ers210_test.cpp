// The ERS-210's and ERS-220's files against the dimensions of their drawing.
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/four_legs.h"
#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/spec/random.h"

namespace btr {
namespace {

class Ers210 : public testing::TestWithParam<const char*> {
 protected:
  RobotModel model = loadModel(std::string(SOURCE_DIR "/resources/robots/") + GetParam());
  FourLegs dog = FourLegs::of(model, "test");
};
INSTANTIATE_TEST_SUITE_P(Robots, Ers210, testing::Values("ers210.wrl", "ers220.wrl"));

TEST_P(Ers210, HipsStandWhereTheDrawingHasThem) {
  for (const FourLegs::Leg& leg : dog.legs) {
    const Eigen::Vector3d drawn(leg.front ? 0.0595 : -0.0595, leg.left ? 0.0592 : -0.0592, 0);
    EXPECT_LT((leg.hip_m - drawn).norm(), 1e-6);
  }
}

TEST_P(Ers210, StandsAtTheDrawnHipHeights) {
  // J3 = 35°: knees 12.8 mm ahead (behind) and 64 below the hips; contacts 22.4 ahead, 16.6 behind them; hips 128.9 and
  // 138.9 mm high; the feet of a pair 119.4 mm apart.
  const LegAngles drawn{0, 0, 35 * M_PI / 180};
  for (const FourLegs::Leg& leg : dog.legs) {
    const Eigen::Vector3d contact = leg.geometry.foot(drawn) - Eigen::Vector3d(0, 0, leg.footRadius_m);
    const Eigen::Vector3d expected =
        leg.front ? Eigen::Vector3d(0.0352, 0.0005, -0.1289) : Eigen::Vector3d(-0.0294, 0.0005, -0.1389);
    EXPECT_LT((contact - expected).norm(), 1e-4);
    EXPECT_NEAR(0.1194, 2 * std::abs((leg.hip_m + leg.turned(contact)).y()), 1e-4);
  }
}

TEST_P(Ers210, FindsAnglesForAnyFootThatItCanReach) {
  Random random(5);
  for (const FourLegs::Leg& leg : dog.legs)
    for (int i = 0; i < 1000; ++i) {
      LegAngles angles;
      for (std::size_t j = 0; j < 3; ++j) angles[j] = random.uniform(leg.limits.lower[j], leg.limits.upper[j]);
      const LegSolution found = leg.geometry.solve(leg.geometry.foot(angles), {0, 0, 1}, leg.limits);
      ASSERT_TRUE(found.feasible());
      EXPECT_LT((leg.geometry.foot(found.angles) - leg.geometry.foot(angles)).norm(), 1e-9);
    }
}

TEST_P(Ers210, WeighsWhatItIsSaidToWeigh) {
  const double mass = massProperties(model, std::vector<double>(model.joints.size(), 0.0)).mass_kg;
  EXPECT_NEAR(model.name == "ERS-210" ? 1.4 : 1.5, mass, 0.005);
  EXPECT_TRUE(model.warnings.empty());
}

TEST_P(Ers210, HasTheJointRangesOfTheRobot) {
  const double degree = M_PI / 180;
  for (const FourLegs::Leg& leg : dog.legs) {
    EXPECT_NEAR(-117 * degree, leg.limits.lower[0], 1e-5);
    EXPECT_NEAR(117 * degree, leg.limits.upper[0], 1e-5);
    EXPECT_NEAR(-11 * degree, leg.limits.lower[1], 1e-5);
    EXPECT_NEAR(89 * degree, leg.limits.upper[1], 1e-5);
    EXPECT_NEAR(-27 * degree, leg.limits.lower[2], 1e-5);
    EXPECT_NEAR(147 * degree, leg.limits.upper[2], 1e-5);
  }
  // The ERS-220 has neither mouth nor tail.
  EXPECT_EQ(model.name == "ERS-210", model.findJoint("MOUTH") >= 0);
  EXPECT_EQ(model.name == "ERS-210", model.findJoint("TAIL_TILT") >= 0);
}

}  // namespace
}  // namespace btr
