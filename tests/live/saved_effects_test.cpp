// A game that is saved while it runs has what effects remember: what is loaded goes on with the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/live/session.h"
#include "tests/live/game_files.h"

namespace btr::test {
namespace saved_effects {

/// Each with its defaults, and a little where those do nothing.
EffectAct actOf(const std::string& name, std::size_t count) {
  const char* const joints[] = {"LF_J1", "LF_J2", "LF_J3", "RF_J1", "RF_J2", "RF_J3",
                                "LR_J1", "LR_J2", "LR_J3", "RR_J1", "RR_J2", "RR_J3"};
  const std::string joint = std::string("red1.") + joints[count % std::size(joints)];
  EffectAct act{"red1", {name, placeFor(effect(name)->place(), joint, "red1.HEAD"), {}}};
  for (const Parameter& parameter : effect(name)->parameters())
    if (parameter.neutral == parameter.byDefault && !parameter.integer)
      act.effect.parameters[parameter.name] = parameter.minimum + 0.02 * (parameter.maximum - parameter.minimum);
  return act;
}

/// Rows of the world's trace.
std::vector<double> onwards(Session& session, int periods) {
  std::vector<double> rows;
  for (int i = 0; i < periods; ++i) {
    session.step();
    session.world().sample(rows);
  }
  return rows;
}

}  // namespace saved_effects

TEST(SavedEffects, GoOnBitForBit) {
  const std::vector<std::string> all = effectsWithASize();
  constexpr std::size_t atOnce = 12;
  for (std::size_t from = 0; from < all.size(); from += atOnce) {
    std::string text, names;
    std::vector<double> rows;
    {
      Session session(dogs(), host());
      for (std::size_t i = from; i < std::min(all.size(), from + atOnce); ++i) {
        session.apply(saved_effects::actOf(all[i], i));
        names += all[i] + " ";
      }
      session.apply(ThrowAct{"ball", {0.5, 0.2, 1}, {0, 5, 0}});
      run(session, 60);
      ASSERT_EQ(session.fault(), "") << names;
      text = toJsonText(session.save());
      rows = saved_effects::onwards(session, 60);
    }
    Session loaded(gameFromJson(text, "saved.json", "."), host());
    EXPECT_EQ(saved_effects::onwards(loaded, 60), rows) << names;
  }
}

}  // namespace btr::test
