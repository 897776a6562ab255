/// The rig was not mounted upright: in its axes gravity is turned by the angle a about x, then b about y (right-hand
/// rule):
///   g' = R_y(b) · R_x(a) · g
/// A definition; turns as in Craig 1986, Introduction to Robotics, chapter 2. For stands and fixed bases. On joints
/// alone it resembles an offset of the position sensor. Neutral: a = b = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class GravityTilt final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {
        {"about_x_rad", "rad", "turn of gravity about x: a stand that leans by 0.03 shows −0.03", -0.5, 0.5, 0.03, 0.0},
        {"about_y_rad", "rad", "turn of gravity about y, in the same sense", -0.5, 0.5, 0.03, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gravity, "a rig that is not mounted upright", "g’ = R_y(b)·R_x(a)·g",
            "a: about_x_rad; b: about_y_rad", "a definition"};
  }
  Place place() const override { return Place::world; }

  void changeScene(btr::Scene& scene, const std::string&, std::span<const double> values) const override {
    if (values[0] == 0 && values[1] == 0) return;
    scene.gravity_m_s2 = Eigen::AngleAxisd(values[1], Eigen::Vector3d::UnitY()) *
                         (Eigen::AngleAxisd(values[0], Eigen::Vector3d::UnitX()) * scene.gravity_m_s2);
  }
};

}  // namespace

BTR_EFFECT(GravityTilt, "gravity_tilt")
