#pragma once
#include <span>

#include "core/live/game.h"
#include "core/model/robot_model.h"
#include "core/sim/readings.h"

namespace btr {

/// Power and gains of joints as they were ordered: a joint that was never enabled is limp.
void applyOrders(const Orders& orders, const RobotModel& model, std::span<JointInput> inputs);

}  // namespace btr
