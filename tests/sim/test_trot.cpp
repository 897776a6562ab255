// The trot that speed is measured with.
#include <gtest/gtest.h>

#include <cmath>

#include "core/sim/trial.h"
#include "core/sim/trot.h"

namespace btr {
namespace {

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
