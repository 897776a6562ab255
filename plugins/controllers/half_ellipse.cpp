/// The half-ellipse gait of Kohl and Stone (ICRA 2004), 12 parameters; a trot of diagonal pairs.
///
/// One cycle of one leg, T seconds long, of which a fraction d on the ground; L is the foot's way on the ground:
///   ground   x = L·(1/2 − φ/d), z = 0                 φ = 0 … d   straight back
///   air      x = −(L/2)·cos(πs), z = h·sin(πs)        s = (φ − d)/(1 − d)   a half ellipse forward
/// The cycle is rounded to an even number of control periods, the ground stage to a whole one; inverse kinematics in
/// every control period. x and y offset: the middle of the foot's way on the ground in the hip's frame, x forward, y
/// outward, below the hip by the body's height there; the ground is the plane through these four places. Skew turns the
/// ways of front legs to the left and of rear legs to the right. LF and RR together, RF and LR half a cycle later.
///
/// The paper's list of parameters is known here from summaries; formulas and ranges are our reading.
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "core/robot/robot.h"

namespace {

using Eigen::Vector3d;

class HalfEllipse final : public uchilsim::Behaviour {
  std::vector<btr::Parameter> parameters() const override {
    return {{"front_height_m", "m", "front locus: height", 0.005, 0.070, 0.025},
            {"front_x_m", "m", "front locus: x offset, ahead of the hip", -0.020, 0.080, 0.055},
            {"front_y_m", "m", "front locus: y offset, outward of the hip", -0.030, 0.060, 0.007},
            {"rear_height_m", "m", "rear locus: height", 0.005, 0.070, 0.025},
            {"rear_x_m", "m", "rear locus: x offset, ahead of the hip", -0.080, 0.020, -0.050},
            {"rear_y_m", "m", "rear locus: y offset, outward of the hip", -0.030, 0.060, 0.005},
            {"length_m", "m", "locus length: way of a foot on the ground", 0, 0.140, 0.070},
            {"skew_rad", "rad", "locus skew in the x-y plane, for turning", -0.3, 0.3, 0},
            {"front_body_height_m", "m", "height of the front hips", 0.070, 0.140, 0.105},
            {"rear_body_height_m", "m", "height of the rear hips", 0.070, 0.140, 0.115},
            {"cycle_s", "s", "time to move through the locus", 0.250, 1.2, 0.776},
            {"ground_fraction", "", "fraction of that time on the ground", 0.3, 0.8, 0.5}};
  }

  std::vector<btr::Parameter> settings() const override { return btr::gaitSettings(); }

  std::vector<double> posture(const btr::RobotModel& model) const override {
    return btr::stanceOf(model, "half_ellipse");
  }

  void setTask(btr::Scene&, const btr::Values& settings) const override { btr::gaitTask(settings, "half_ellipse"); }

  void start(const uchilsim::Robot& robot, const btr::Values& settings, std::span<const double> p) override {
    assert(p.size() == 12);
    const btr::GaitTask task = btr::gaitTask(settings, "half_ellipse");
    const btr::FourLegs dog = btr::FourLegs::of(robot.model, "half_ellipse");
    const double period_s = robot.period_s;
    const long cycle = std::max(4L, 2 * std::lround(p[10] / period_s / 2));
    const long ground = std::clamp(std::lround(p[11] * static_cast<double>(cycle)), 2L, cycle - 2);
    const double groundTime = static_cast<double>(ground) * period_s;

    const btr::FootPlaces places(dog, Vector3d(p[1], p[2], -p[8]), Vector3d(p[4], p[5], -p[9]));
    std::array<std::vector<btr::FootPoint>, 4> paths;
    for (std::size_t i = 0; i < 4; ++i) {
      const btr::FourLegs::Leg& leg = dog.legs[i];
      const double height = leg.front ? p[0] : p[3];
      const Vector3d stroke = places.stroke(leg, task, p[6] / groundTime, groundTime, p[7]);
      for (long frame = 0; frame < cycle; ++frame) {
        double x = 0.5 - static_cast<double>(frame) / static_cast<double>(ground), z = 0;
        if (frame >= ground) {
          const double s = static_cast<double>(frame - ground) / static_cast<double>(cycle - ground);
          x = -0.5 * std::cos(M_PI * s);
          z = height * std::sin(M_PI * s);
        }
        paths[i].push_back({static_cast<double>(frame), places.at(leg, Vector3d(0, 0, z) - stroke * x)});
      }
    }
    const long half = cycle / 2;
    steps_.emplace(robot.period_s, std::vector<double>(robot.start.begin(), robot.start.end()), dog, task,
                   btr::Gait(dog, paths, {0, half, half, 0}, cycle));
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    steps_->targets(senses.time_s, orders.targets);
  }

  double duration_s() const override { return steps_->duration(); }
  btr::Values remarks() const override { return steps_->remarks(); }

  std::optional<btr::GaitSteps> steps_;
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(HalfEllipse, "half_ellipse")
