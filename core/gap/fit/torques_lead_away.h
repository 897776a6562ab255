#pragma once
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// A torque that was recorded with noise, and fed to an arm that nothing holds, leads it away from its recorded path
/// within seconds, whatever the simulator. The other way round, the torque that its path takes, does not. Where most of
/// the joints with a torque as command are off by half of what they move (r.m.s. over the segments, nothing fitted), a
/// note says so, and what to do, before all others. Call it when segments are cut.
void sayIfTorquesLeadAway(FitProblem& problem);

}  // namespace btr
