#pragma once
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// A torque that was recorded with noise, and fed to an arm that nothing holds, leads it away from its recorded path
/// within seconds, whatever the simulator; one that lacks a spring, in less. True where most of the joints with a
/// torque as command are off by half of what they move (r.m.s. over the segments, nothing fitted). Call it when
/// segments are cut.
bool doTorquesLeadAway(const FitProblem& problem);
/// A note that says so, and what to do, before all others: the other way round, the torque that the path takes, nothing
/// leads away.
void sayIfTorquesLeadAway(FitProblem& problem);

}  // namespace btr
