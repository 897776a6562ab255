#pragma once
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// Whether the model `with` more than `without` also does better at settings of the mapping (gains, loads) that it was
/// not fitted to: the trials of each setting are predicted by fits of both to all others, and squared errors summed.
/// True where all trials have the same settings. A curve that bends with a servo's gain predicts none that is not
/// there. (XL330: curves over the motor's torque that halve the error at two gains and double it at the third.)
bool holdsAtOtherSettings(const FitProblem& problem, const Fit& without, const Fit& with, int iterations);

}  // namespace btr
