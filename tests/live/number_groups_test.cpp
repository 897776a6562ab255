// The numbers of a simulator that the window offers: each is what makeScene() reads, under the key that a simulator
// has.
#include "core/live/number_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/live/session.h"

namespace btr {
namespace {

const PluginHost& hostOfNumbers() {
  static const PluginHost host(PLUGIN_DIR);
  return host;
}

Game gameOfNumbers() {
  return gameFromJson(
      R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "floor": {"friction": 0.7},
    "robots": [{"name": "dog", "model": ")" SOURCE_DIR R"(/resources/robots/ers7.wrl"}]}})",
      "game", "");
}

TEST(NumberGroups, every_key_is_one_of_a_simulator_and_a_links_number_is_read_back) {
  const Game game = gameOfNumbers();
  const ModelSet models = loadModels(game.scene);
  int keys = 0;
  for (const NumberGroup& group : numberGroups(game, models, "dog"))
    for (const Parameter& parameter : group.parameters) {
      ++keys;
      const std::string& key = group.key.at(parameter.name);
      const double wanted =
          std::clamp(group.usual.at(parameter.name) * 1.25 + 0.001, parameter.minimum, parameter.maximum);
      const Scene changed = makeScene(game.scene, models, {{{key, wanted}}, {}}, hostOfNumbers().effectFactory());
      if (group.of != NumberGroup::Of::link) continue;
      const ModelSet after{{game.scene.robots[0].model, std::make_shared<const RobotModel>(changed.robots[0].model)}};
      for (const NumberGroup& now : numberGroups(game, after, "dog"))
        if (now.of == group.of && now.item == group.item) {
          EXPECT_NEAR(now.usual.at(parameter.name), wanted, 1e-12) << key;
        }
    }
  EXPECT_GT(keys, 18 * 5 + 18 * 7);  // its joints' servos, its links
}

TEST(NumberGroups, floor_and_gravity_are_everybodys_and_masses_are_the_files) {
  const Game game = gameOfNumbers();
  const ModelSet models = loadModels(game.scene);
  const NumberGroup all = numberGroups(game, models, "").front();
  EXPECT_EQ(all.usual.at("friction"), 0.7);
  EXPECT_NEAR(all.usual.at("gravity_m_s2"), 9.81, 1e-12);
  const NumberGroup dog = numberGroups(game, models, "dog").front();
  EXPECT_FALSE(dog.usual.contains("friction"));
  double legs = 0;
  for (const Link& link : models.begin()->second->links)
    if (link.massGroup.starts_with("leg")) legs += link.inertial.mass_kg;
  EXPECT_NEAR(4 * dog.usual.at("leg_mass_kg"), legs, 1e-9);
}

TEST(NumberGroups, effects_go_where_their_kind_of_place_is) {
  const Game game = gameOfNumbers();
  const ModelSet models = loadModels(game.scene);
  const auto backlash = hostOfNumbers().effect("backlash");
  EXPECT_EQ(placesFor(*backlash, game, models, "dog").size(), 18u);
  EXPECT_EQ(placesFor(*hostOfNumbers().effect("slip"), game, models, ""), std::vector<std::string>{"floor"});
  EXPECT_TRUE(placesFor(*hostOfNumbers().effect("slip"), game, models, "dog").empty());
}

}  // namespace
}  // namespace btr
