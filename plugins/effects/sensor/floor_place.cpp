/// What tracks the balls has a frame of its own, in which the floor is not where it should be: it lies higher by h and
/// is tilted by the angle a about x, then b about y, while down stays down in that frame. A ball at p above the floor
/// is said to be at T·p, T = (translation by h·z)·R_y(b)·R_x(a), and gravity in the floor's axes is
/// (R_y(b)·R_x(a))⁻¹·g. A definition; turns as in Craig 1986, Introduction to Robotics, chapter 2. (Where gravity leans
/// in the recording's frame and the floor does not, that is ground_slope.) Neutral: h = a = b = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class FloorPlace final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"height_m", "m", "the floor is higher than the recording's zero", -0.2, 0.2, 0.01, 0.0},
            {"about_x_rad", "rad", "tilt of the floor about x", -0.2, 0.2, 0.01, 0.0},
            {"about_y_rad", "rad", "tilt of the floor about y, positive falls forward", -0.2, 0.2, 0.01, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::sensor, "a floor that is not where the recording's frame has it",
            "p’ = h·z + R_y(b)·R_x(a)·p,  g’ = (R_y(b)·R_x(a))^−1·g",
            "h: height_m; a: about_x_rad; b: about_y_rad; p: place of a ball; p’: as recorded", "a definition"};
  }
  Place place() const override { return Place::ball; }

  void changeScene(btr::Scene& scene, const std::string&, std::span<const double> values) const override {
    if (values[1] != 0 || values[2] != 0) scene.gravity_m_s2 = tilt(values).transpose() * scene.gravity_m_s2;
  }
  Eigen::Isometry3d trackedFrame(std::span<const double> values) const override {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    frame.translation().z() = values[0];
    frame.linear() = tilt(values);
    return frame;
  }

 private:
  static Eigen::Matrix3d tilt(std::span<const double> values) {
    return (Eigen::AngleAxisd(values[2], Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(values[1], Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }
};

}  // namespace

BTR_EFFECT(FloorPlace, "floor_place")
