#pragma once
#include <cstddef>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/replay/start_state.h"

namespace btr {

/// Cuts all trials into segments of `window_s` (0: whole trials), with blocks and folds.
void cutSegments(FitProblem& problem, double window_s);

/// The state at a row from the samples on both sides of it, and how uncertain each coordinate is.
StartState stateAt(const FitProblem& problem, std::size_t trial, std::size_t row, std::vector<Nuisance>& nuisances);

/// Simulates a segment from its start, shifted by `shift` (by nuisance, in their units), and returns its residuals.
/// After a fault they are 100.
std::vector<double> residualsOf(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                const std::vector<double>& shift);

}  // namespace btr
