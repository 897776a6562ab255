/// The floor is not level. It is tilted by the angle a about x, then b about y (right-hand rule: b > 0 falls towards
/// +x). Everything is described in the floor's own axes, in which gravity then leans: g' = (R_y(b)·R_x(a))⁻¹ · g. A
/// definition; turns as in Craig 1986, Introduction to Robotics, chapter 2. Exact for all that stands, rolls or falls;
/// the start poses are given relative to the floor, as before. Neutral: a = b = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class GroundSlope final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"about_x_rad", "rad", "tilt of the floor about x", -0.3, 0.3, 0.03, 0.0},
            {"about_y_rad", "rad", "tilt of the floor about y, positive falls forward", -0.3, 0.3, 0.03, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gravity, "a floor that is not level", "g’ = (R_y(b)·R_x(a))^−1·g in the floor’s axes",
            "a: about_x_rad; b: about_y_rad", "a definition"};
  }
  Place place() const override { return Place::floor; }

  void changeScene(btr::Scene& scene, const std::string&, std::span<const double> values) const override {
    if (values[0] == 0 && values[1] == 0) return;
    const Eigen::Matrix3d tilt = (Eigen::AngleAxisd(values[1], Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(values[0], Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
    scene.gravity_m_s2 = tilt.transpose() * scene.gravity_m_s2;
  }
};

}  // namespace

BTR_EFFECT(GroundSlope, "ground_slope")
