#include <array>

#include "core/spec/error.h"
#include "tests/prove/reality.h"
#include "tests/rival/mujoco_world.h"

namespace btr::prove {
namespace {

double read(rival::MujocoWorld& world, const MeasuredColumn& column, double dt) {
  const Eigen::Quaterniond q(world.base().linear());
  switch (column.what) {
    case MeasuredColumn::What::position:
      return world.measured(column.part, dt);
    case MeasuredColumn::What::rate:
      return world.rate(column.part);
    case MeasuredColumn::What::basePosition:
      return world.base().translation()[static_cast<int>(column.part)];
    case MeasuredColumn::What::baseOrientation:
      return (q.w() < 0 ? -1 : 1) * std::array{q.w(), q.x(), q.y(), q.z()}[column.part];
    case MeasuredColumn::What::ballPosition:
      break;
  }
  throw InputError("--engine mujoco: balls are not part of it");
}

}  // namespace

bool hasMujoco() { return true; }

Truth simulateMujoco(const Scene& scene, const TrialPlan& plan, const std::vector<MeasuredColumn>& columns) {
  Truth truth;
  truth.values.assign(columns.size(), std::vector<double>(plan.rows, 0.0));
  rival::MujocoWorld world(scene);
  world.start(plan.jointStart);
  if (plan.settle_s > 0) world.advance(inputsOf(plan, 0), plan.settle_s);
  for (std::size_t row = 0; row < plan.rows; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      truth.values[i][row] = read(world, columns[i], row == 0 ? 0 : plan.sample_s);
    if (row + 1 == plan.rows) break;
    world.advance(inputsOf(plan, row), plan.sample_s);
    if (world.failed()) {
      truth.fault = "MuJoCo: a bad acceleration, speed or position";
      break;
    }
  }
  return truth;
}

}  // namespace btr::prove
