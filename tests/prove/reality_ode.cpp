#include "tests/prove/reality.h"

#include "core/sim/tracked_frame.h"

namespace btr::prove {
namespace {

double read(const World& world, const Eigen::Isometry3d& frame, const RobotReadings& robot,
            const MeasuredColumn& column) {
  const Eigen::Quaterniond q(robot.base.linear());
  switch (column.what) {
    case MeasuredColumn::What::position:
      return robot.position[column.part];
    case MeasuredColumn::What::rate:
      return robot.rate[column.part];
    case MeasuredColumn::What::basePosition:
      return robot.base.translation()[static_cast<int>(column.part)];
    case MeasuredColumn::What::baseOrientation:
      return (q.w() < 0 ? -1 : 1) * std::array{q.w(), q.x(), q.y(), q.z()}[column.part];
    case MeasuredColumn::What::ballPosition:
      break;
  }
  return (frame * world.ball(0).position_m)[static_cast<int>(column.part)];
}

BallState asTracked(BallState ball, const Eigen::Isometry3d& frame) {
  ball.position_m = frame * ball.position_m;
  ball.velocity_m_s = frame.linear() * ball.velocity_m_s;
  ball.spin_rad_s = frame.linear() * ball.spin_rad_s;
  return ball;
}

}  // namespace

std::vector<JointInput> inputsOf(const TrialPlan& plan, std::size_t row) {
  std::vector<JointInput> inputs;
  if (plan.commands.empty()) return inputs;
  for (const double command : plan.commands[row]) {
    inputs.push_back({.command = command});
    if (!plan.enabled.empty()) inputs.back().enabled = plan.enabled[row] != 0;
  }
  return inputs;
}

Truth simulateOde(const Scene& scene, const TrialPlan& plan, const std::vector<MeasuredColumn>& columns) {
  constexpr std::uint64_t seed = 1;
  Truth truth;
  truth.values.assign(columns.size(), std::vector<double>(plan.rows, 0.0));
  World world(scene, seed);
  const bool robot = !scene.robots.empty(), ball = !scene.balls.empty();
  if (robot) {
    const std::vector<double> still(plan.jointStart.size(), 0.0);
    world.setRobot(0, scene.robots[0].start, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), plan.jointStart, still);
  }
  if (ball) world.setBall(0, plan.ball);
  std::vector<std::vector<JointInput>> inputs;
  if (robot) inputs.push_back(inputsOf(plan, 0));
  if (plan.settle_s > 0) world.advance(inputs, plan.settle_s);

  const Eigen::Isometry3d frame = trackedFrame(scene);
  RobotReadings readings;
  for (std::size_t row = 0; row < plan.rows; ++row) {
    if (robot) readings = world.robot(0);
    if (row == 0) {
      if (robot)
        truth.start.robots.push_back({readings.base, readings.baseVelocity_m_s, readings.baseSpin_rad_s,
                                      readings.position, readings.rate,
                                      plan.settle_s > 0 && !scene.robots[0].freeBase});
      if (ball) truth.start.balls.push_back(asTracked(world.ball(0), frame));
    }
    for (std::size_t i = 0; i < columns.size(); ++i) truth.values[i][row] = read(world, frame, readings, columns[i]);
    if (row + 1 == plan.rows) break;
    if (robot) inputs[0] = inputsOf(plan, row);
    world.advance(inputs, plan.sample_s);
    truth.fault = world.fault();
    if (!truth.fault.empty()) break;
  }
  return truth;
}

}  // namespace btr::prove
