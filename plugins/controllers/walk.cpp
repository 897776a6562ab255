/// The walk of the UCHILSIM papers: 20 parameters of a foot's locus and its timing; a trot of diagonal pairs.
///
/// One cycle of one leg, all times rounded to whole control periods (an even number of them in the cycle):
///   T_ground = L/v    T = T_ground/(1 − f)    T_air = T − T_ground = t_lift + T_mid + t_lift    T_mid ≥ 2 periods
///   ground   straight back over L at the ground speed v; solved in every control period
///   lift     straight up at −L/2 to z_lift
///   air      from (−L/2, z_lift) over (0, z_air) to (L/2, z_descend), solved at N points, joints go straight between:
///              x = −L/2·cos(πs)    z = z_end + (z_air − z_end)·(1 − |2x/L|^p)^(1/p)    s = 0 … 1 evenly in time
///              z_end = z_lift before the middle, z_descend behind it; p = 1 a triangle, 2 a half ellipse, large a box
///   descend  straight down at L/2 to the ground, in the time of the lift
///   z_lift, z_air, z_descend = lift factor × the heights of front or rear legs
/// x, y, z of an operating point: the middle of the foot's way on the ground in the hip's frame, x forward, y outward,
/// z up. The ground is the plane through the four of them: ways lie in it, heights stand on it. Skew turns the ways of
/// front legs to the left and of rear legs to the right, which turns the robot. LF and RR together, RF and LR half a
/// cycle later.
///
/// The papers name the parameters; formulas and ranges are our reading of them, the ranges around the gaits of real
/// robots. A locus that leaves a leg's reach is cut there: see Gait.
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "core/robot/robot.h"

namespace {

using Eigen::Vector3d;

/// The parameter vector by name, in its order.
struct Locus {
  double length, shape, liftFactor;
  std::array<double, 3> frontHeights, rearHeights;  ///< lift, air, descend
  Vector3d front, rear;                             ///< operating points
  double skew, groundSpeed, airFraction, liftTime;
  long airPoints;

  explicit Locus(std::span<const double> p)
      : length(p[0]),
        shape(p[1]),
        liftFactor(p[2]),
        frontHeights{p[3], p[4], p[5]},
        rearHeights{p[6], p[7], p[8]},
        front(p[9], p[10], p[11]),
        rear(p[12], p[13], p[14]),
        skew(p[15]),
        groundSpeed(p[16]),
        airFraction(p[17]),
        liftTime(p[18]),
        airPoints(std::lround(p[19])) {}
};

/// Control periods of the stages.
struct Timing {
  long ground, lift, middle;

  Timing(const Locus& locus, double period_s) {
    const double exactGround = locus.length / locus.groundSpeed / period_s;
    ground = std::max(2L, std::lround(exactGround));
    // The cycle has an even number of periods, so that half a cycle is a whole number.
    const double exactCycle = exactGround / (1 - locus.airFraction);
    const long cycle = std::max(ground + 2 + ground % 2, 2 * std::lround(exactCycle / 2));
    const long air = cycle - ground;
    lift = std::min(std::lround(locus.liftTime / period_s), (air - 2) / 2);
    middle = air - 2 * lift;
  }
  long cycle() const { return ground + 2 * lift + middle; }
};

/// Height of the air stage over the ground at x/L = −½ … ½.
double airHeight(const Locus& locus, const std::array<double, 3>& heights, double x) {
  const double end = x < 0 ? heights[0] : heights[2];
  const double bow = std::pow(1 - std::pow(std::min(1.0, std::abs(2 * x)), locus.shape), 1 / locus.shape);
  return end + (heights[1] - end) * bow;
}

/// The leg's cycle from touching down.
std::vector<btr::FootPoint> pathOf(const btr::FourLegs::Leg& leg, const Locus& locus, const Timing& timing,
                                   const btr::FootPlaces& places, const btr::GaitTask& task, double period_s) {
  std::array<double, 3> heights = leg.front ? locus.frontHeights : locus.rearHeights;
  for (double& height : heights) height *= locus.liftFactor;
  const double groundTime = static_cast<double>(timing.ground) * period_s;
  const Vector3d stroke = places.stroke(leg, task, locus.length / groundTime, groundTime, locus.skew);  // front to back
  const auto at = [&](double x, double z) -> Vector3d { return places.at(leg, Vector3d(0, 0, z) - stroke * x); };
  const auto share = [](long part, long whole) { return static_cast<double>(part) / static_cast<double>(whole); };

  std::vector<btr::FootPoint> path;
  for (long i = 0; i < timing.ground; ++i)
    path.push_back({static_cast<double>(i), at(0.5 - share(i, timing.ground), 0)});
  const long liftBegins = timing.ground, airBegins = liftBegins + timing.lift;
  for (long i = 0; i < timing.lift; ++i)
    path.push_back({static_cast<double>(liftBegins + i), at(-0.5, heights[0] * share(i, timing.lift))});
  for (long n = 0; n < locus.airPoints; ++n) {
    const double s = share(n, locus.airPoints), x = -0.5 * std::cos(M_PI * s);
    path.push_back(
        {static_cast<double>(airBegins) + s * static_cast<double>(timing.middle), at(x, airHeight(locus, heights, x))});
  }
  // The last air point is the first of the descent; without one, the foot touches down from there at once.
  const long descendBegins = airBegins + timing.middle;
  for (long i = 0; i < timing.lift; ++i)
    path.push_back({static_cast<double>(descendBegins + i), at(0.5, heights[2] * (1 - share(i, timing.lift)))});
  return path;
}

class Walk final : public uchilsim::Behaviour {
  std::vector<btr::Parameter> parameters() const override {
    return {{"length_m", "m", "locus length: way of a foot on the ground", 0.030, 0.110, 0.070},
            {"shape", "", "locus shape: 1 triangle, 2 half ellipse, large a box", 1, 6, 2},
            {"lift_factor", "", "times the heights of all loci", 0.3, 2, 1},
            {"front_lift_m", "m", "front feet: height at the end of lifting", 0.002, 0.030, 0.012},
            {"front_air_m", "m", "front feet: height in the middle of the air stage", 0.008, 0.050, 0.025},
            {"front_descend_m", "m", "front feet: height where descending begins", 0.002, 0.030, 0.012},
            {"rear_lift_m", "m", "rear feet: height at the end of lifting", 0.002, 0.030, 0.012},
            {"rear_air_m", "m", "rear feet: height in the middle of the air stage", 0.008, 0.050, 0.022},
            {"rear_descend_m", "m", "rear feet: height where descending begins", 0.002, 0.030, 0.012},
            {"front_x_m", "m", "front operating point, ahead of the hip", 0.010, 0.080, 0.055},
            {"front_y_m", "m", "front operating point, outward of the hip", -0.005, 0.040, 0.007},
            {"front_z_m", "m", "front operating point, above the hip", -0.130, -0.075, -0.105},
            {"rear_x_m", "m", "rear operating point, ahead of the hip", -0.070, 0.010, -0.050},
            {"rear_y_m", "m", "rear operating point, outward of the hip", -0.005, 0.040, 0.005},
            {"rear_z_m", "m", "rear operating point, above the hip", -0.140, -0.080, -0.115},
            {"skew_rad", "rad", "turns front loci to the left, rear ones to the right", -0.3, 0.3, 0},
            {"ground_speed_m_s", "m/s", "speed of the feet on the ground", 0.080, 0.450, 0.180},
            {"air_fraction", "", "share of the cycle in the air", 0.25, 0.65, 0.5},
            {"lift_time_s", "s", "time of lifting, and of descending", 0, 0.080, 0.032},
            {"air_points", "", "points of the air stage", 2, 16, 6, {}, true}};
  }

  std::vector<btr::Parameter> settings() const override { return btr::gaitSettings(); }

  std::vector<double> posture(const btr::RobotModel& model) const override { return btr::stanceOf(model, "walk"); }

  void setTask(btr::Scene&, const btr::Values& settings) const override { btr::gaitTask(settings, "walk"); }

  void start(const uchilsim::Robot& robot, const btr::Values& settings, std::span<const double> parameters) override {
    assert(parameters.size() == 20);
    const btr::GaitTask task = btr::gaitTask(settings, "walk");
    const btr::FourLegs dog = btr::FourLegs::of(robot.model, "walk");
    const Locus locus(parameters);
    const Timing timing(locus, robot.period_s);
    const btr::FootPlaces places(dog, locus.front, locus.rear);
    std::array<std::vector<btr::FootPoint>, 4> paths;
    for (std::size_t i = 0; i < 4; ++i) paths[i] = pathOf(dog.legs[i], locus, timing, places, task, robot.period_s);
    const long half = timing.cycle() / 2;
    steps_.emplace(robot.period_s, std::vector<double>(robot.start.begin(), robot.start.end()), dog, task,
                   btr::Gait(dog, paths, {0, half, half, 0}, timing.cycle()));
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    steps_->targets(senses.time_s, orders.targets);
  }

  double duration_s() const override { return steps_->duration(); }
  btr::Values remarks() const override { return steps_->remarks(); }

  std::optional<btr::GaitSteps> steps_;
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(Walk, "walk")
