/// A point of mass m that is fixed to a link and that the model does not have: a camera, a cable, a battery.
///   M' = M + m,   c' = (M·c + m·r)/M',   I' = I + Steiner's terms of both about c'        (r = c + offset, link's
///   axes)
/// Neutral: m = 0. With the offset at 0 it only makes the link heavier.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

Eigen::Matrix3d steiner(double mass_kg, const Eigen::Vector3d& d) {
  return mass_kg * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
}

class Payload final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"mass_kg", "kg", "added mass", 0, 1, 0.05, 0.0},
            {"x_m", "m", "ahead of the link's centre of mass, link's x", -0.3, 0.3, 0},
            {"y_m", "m", "beside the link's centre of mass, link's y", -0.3, 0.3, 0},
            {"z_m", "m", "above the link's centre of mass, link's z", -0.3, 0.3, 0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::link, "a mass on a link that the model does not have",
            "M’ = M + m,  c’ = (M·c + m·r)/M’", "m: mass_kg at x_m, y_m, z_m from the centre of mass c", "Steiner"};
  }
  Place place() const override { return Place::link; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    const double mass = values[0];
    if (mass == 0) return;
    btr::Inertial& body = linkAt(scene, at).inertial;
    const Eigen::Vector3d offset(values[1], values[2], values[3]);
    const Eigen::Vector3d shift = offset * (mass / (body.mass_kg + mass));
    body.inertia_kg_m2 += steiner(body.mass_kg, shift) + steiner(mass, offset - shift);
    body.centreOfMass_m += shift;
    body.mass_kg += mass;
  }

  /// The link of "ROBOT.LINK".
  static btr::Link& linkAt(btr::Scene& scene, const std::string& at) {
    for (btr::SceneRobot& robot : scene.robots)
      for (btr::Link& link : robot.model.links)
        if (at == robot.name + "." + link.name) return link;
    throw btr::InputError("payload: the scene has no link \"" + at + "\"; write ROBOT.LINK");
  }
};

}  // namespace

BTR_EFFECT(Payload, "payload")
