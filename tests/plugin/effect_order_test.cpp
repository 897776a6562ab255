// The order in which a simulator lists its effects says nothing about physics.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/plugin/effect_worlds.h"

namespace btr {
namespace {

using test::host;

/// At joints and links and of the drives' supply, each as large as an effect usually is.
std::vector<std::string> effectsOfARig() {
  std::vector<std::string> names;
  for (const std::string& name : host().effects()) {
    const Effect::Place place = test::effect(name)->place();
    if (place == Effect::Place::joint || place == Effect::Place::link || test::effect(name)->onEveryJoint())
      names.push_back(name);
  }
  return names;
}

std::vector<double> usual(const std::string& name) {
  std::vector<double> values;
  for (const Parameter& p : test::effect(name)->parameters()) values.push_back(p.byDefault);
  if (name == "torque_speed_limit") values[0] = 4;  // below what the servo gives
  return values;
}

TEST(OrderOfEffects, OfTwoInAnyOrderIsTheSameMotion) {
  const test::Trial trial{test::armScene(), 0.8};
  const std::vector<std::string> names = effectsOfARig();
  ASSERT_LT(10u, names.size());
  const auto motionOf = [&](const std::string& first, const std::string& second) {
    Scene scene = test::withEffect(trial.scene, test::effect(first), first, usual(first));
    scene = test::withEffect(scene, test::effect(second), second, usual(second));
    return test::run(scene, trial).values;
  };
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto one = motionOf(names[a], names[b]), other = motionOf(names[b], names[a]);
      ASSERT_EQ(one.size(), other.size()) << names[a] << ", " << names[b];
      double most = 0;
      for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, std::abs(one[i] - other[i]));
      EXPECT_LT(most, 1e-6) << names[a] << ", " << names[b];
    }
}

}  // namespace
}  // namespace btr
