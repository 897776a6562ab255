/// The floor gives way: a softer layer in series with the contact's stiffness k0, and more damping beside it.
///   1/k = 1/k0 + c,   d = d0·k/k0 + Δd      c in m/N, d in N·s/m
/// Springs in series (Hooke) beside the engine's spring and damper of a contact (Smith, Open Dynamics Engine User
/// Guide: ERP and CFM). The contact keeps its relaxation time d0/k0, so a carpet that is only softer does not also
/// become more viscous. For balls and all parts of robots, at each point of contact. Neutral: c = Δd = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ContactCompliance final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"compliance_m_n", "m/N", "way per force that the floor gives way more", 0, 0.05, 5e-4, 0.0},
            {"damping_n_s_m", "N·s/m", "added damping of the contact", 0, 1000, 5, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "a floor that gives way more, and damps more",
            "1/k = 1/k_0 + c,  d = d_0·k/k_0 + Δd", "c: compliance_m_n; Δd: damping_n_s_m",
            "Smith, Open Dynamics Engine User Guide"};
  }
  Place place() const override { return Place::floor; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    if (!scene.floor) throw btr::InputError("contact_compliance: the scene has no \"" + at + "\"");
    const double softer = 1 / (1 + scene.floor->stiffness_n_m * values[0]);
    scene.floor->stiffness_n_m *= softer;
    scene.floor->damping_n_s_m = scene.floor->damping_n_s_m * softer + values[1];
  }
};

}  // namespace

BTR_EFFECT(ContactCompliance, "contact_compliance")
