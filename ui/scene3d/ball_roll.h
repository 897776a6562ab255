#pragma once
#include "core/sim/trial.h"

namespace btr::ui {

/// A trial ends when its ball rolls freely: where it will lie is then known from the uniform deceleration
/// (TrialResult's closed form). For people who look at a replay, the rest of the way as further rows of the trace: the
/// ball `name` rolls on in a straight line, its speed falls evenly from that of the last two rows to zero at `rest_m`;
/// everything else stays as it is. Nothing is added where the ball already lies there, or no such speed leads there.
void appendRoll(Trace& trace, const std::string& name, double radius_m, const Eigen::Vector3d& rest_m);

}  // namespace btr::ui
