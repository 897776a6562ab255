/// Hard hits bounce back less than soft ones: of the restitution e that floor and ball have,
///   e' = e/(1 + k·v)      v: speed of the hit along the normal [m/s], k in s/m
/// remains, which falls as measured curves do between the slow hits where e holds and fast ones, e' ~ 1/v. (Stronge
/// 2000, Impact Mechanics: losses grow with the speed of impact; Johnson 1985, Contact Mechanics, ch. 11: e ~ v^(−1/4)
/// where a body yields.) Does nothing where nothing bounces. Neutral: k = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class RestitutionBySpeed final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"loss_s_m", "s/m", "loss of restitution per speed of the hit", 0, 2, 0.1, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "hard hits that bounce back less than soft ones", "e’ = e/(1 + k·v)",
            "k: loss_s_m; v: speed of the hit", "Stronge 2000; Johnson 1985"};
  }
  Place place() const override { return Place::floor; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    if (!scene.floor) throw btr::InputError("restitution_by_speed: the scene has no \"" + at + "\"");
    scene.floor->bounceLoss_s_m += values[0];
  }
};

}  // namespace

BTR_EFFECT(RestitutionBySpeed, "restitution_by_speed")
