#pragma once
#include <string>
#include <vector>

#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "tests/prove/blind_world.h"

namespace btr::prove {

/// What happens in a trial, before a sensor adds noise.
struct Truth {
  std::vector<std::vector<double>> values;  ///< by column, by row
  StartState start;                         ///< when the recording begins
  std::string fault;                        ///< empty, or why the simulation was ended
};

/// Runs the plan in our own simulator at the scene's step.
Truth simulateOde(const Scene& scene, const TrialPlan& plan, const std::vector<MeasuredColumn>& columns);

/// Runs the plan in MuJoCo at the scene's step: the same bodies, drives and effects, but its own contacts, its own
/// integrator, its own dry friction. One robot, no ball. Throws InputError if this program was built without it.
Truth simulateMujoco(const Scene& scene, const TrialPlan& plan, const std::vector<MeasuredColumn>& columns);
bool hasMujoco();

/// Inputs of the first robot in one row.
std::vector<JointInput> inputsOf(const TrialPlan& plan, std::size_t row);

}  // namespace btr::prove
