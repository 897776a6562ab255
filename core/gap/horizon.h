#pragma once
#include "core/gap/fit_problem.h"

namespace btr {

/// How far free runs of a robot on the floor can be compared: feet land a little earlier or later, and from then on two
/// runs of the same simulator, begun within what the recording tells of the start or with half the step, go ways of
/// their own. What was recorded after that says nothing of the simulator, whatever it is. Sets FitTrial::compared of
/// each trial and notes where that leaves samples out; segments (whole trials) have to be cut again.
void keepPredictable(FitProblem& problem);

}  // namespace btr
