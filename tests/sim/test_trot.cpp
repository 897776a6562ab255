// The leg's inverse kinematics and the trot that speed is measured with.
#include <gtest/gtest.h>

#include <cmath>

#include "core/sim/trial.h"
#include "core/sim/trot.h"
#include "core/spec/random.h"

namespace btr {
namespace {

TEST(LegGeometry, FindsTheAnglesOfAnyFootItCanReach) {
  const LegGeometry front{{0.009, 0.0047, -0.0695}, {-0.01124, 0, -0.07607}, 1};
  const LegGeometry rear{{-0.009, 0.0047, -0.0695}, {0.0198, 0, -0.0769}, -1};
  Random random(5);
  for (const auto& leg : {front, rear})
    for (int i = 0; i < 2000; ++i) {
      const LegAngles given{random.uniform(-1.5, 1.5), random.uniform(-0.17, 1.2), random.uniform(-0.4, 2.1)};
      bool reached = true;
      const Eigen::Vector3d foot = leg.foot(given);
      const LegAngles found = leg.angles(foot, given, reached);
      EXPECT_TRUE(reached);
      EXPECT_LT((leg.foot(found) - foot).norm(), 1e-12);
    }
}

TEST(LegGeometry, GivesTheDrawingsFeet) {
  // ERS-7 at (0, 0, 30°): foot 37.3 mm ahead (30.3 behind) and 141.0 (146.0) below the hip.
  const LegGeometry front{{0.009, 0.0047, -0.0695}, {-0.01124, 0, -0.07607}, 1};
  const LegGeometry rear{{-0.009, 0.0047, -0.0695}, {0.0198, 0, -0.0769}, -1};
  const LegAngles drawn{0, 0, M_PI / 6};
  EXPECT_LT((front.foot(drawn) - Eigen::Vector3d(0.0373, 0.0047, -0.141)).norm(), 1e-4);
  EXPECT_LT((rear.foot(drawn) - Eigen::Vector3d(-0.0303, 0.0047, -0.146)).norm(), 1e-4);
}

TEST(LegGeometry, SaysWhenAFootIsOutOfReach) {
  const LegGeometry front{{0.009, 0.0047, -0.0695}, {-0.01124, 0, -0.07607}, 1};
  bool reached = true;
  front.angles({0, 0.0047, -0.2}, {0, 0, 0.3}, reached);
  EXPECT_FALSE(reached);
}

TEST(Trot, WalksForwardWithoutFalling) {
  SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/walk.json");
  spec.step_s = 0.004;
  Scene scene = makeScene(spec, loadModels(spec), {}, {});
  const Trot trot;
  trot.arrange(scene, {});
  const auto result = runTrial(scene, trot, {{"duration_s", 5}}, {}, 1);
  EXPECT_EQ(TrialResult::Outcome::finished, result.outcome) << result.detail;
  EXPECT_FALSE(result.fell);
  // 60 mm in each half of a 0.48 s cycle is 0.25 m/s if no foot slips.
  const Eigen::Vector3d way = result.baseEnd_m - result.baseStart_m;
  EXPECT_GT(way.x(), 0.5 * 0.25 * 5);
  EXPECT_LT(way.x(), 1.3 * 0.25 * 5);
  EXPECT_LT(std::abs(way.y()), 0.15 * way.x());
}

}  // namespace
}  // namespace btr
