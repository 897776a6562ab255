#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/replay/start_state.h"

namespace btr {

/// Cuts all trials into segments of `window_s` (0: whole trials), with blocks and folds.
void cutSegments(FitProblem& problem, double window_s);

/// The problem with some of its trials alone, and of shifts by segment those of these.
FitProblem only(const FitProblem& problem, const std::vector<std::size_t>& trials);
std::vector<std::vector<double>> only(const FitProblem& problem, const std::vector<std::vector<double>>& shifts,
                                      const std::vector<std::size_t>& trials);

/// The state at a row from the samples on both sides of it, and how uncertain each coordinate is.
StartState stateAt(const FitProblem& problem, std::size_t trial, std::size_t row, std::vector<Nuisance>& nuisances);

/// False for a ball's spin that neither a floor nor an effect of the scene asks for.
bool isFelt(const Segment& segment, const Nuisance& nuisance, const Scene& scene);

/// The start of a segment, shifted by `shift` (by nuisance, in their units).
StartState shiftedStart(const Segment& segment, const std::vector<double>& shift);

/// Residual [noise floors] of a sample that the simulation did not reach, as it was ended by a fault: large, so that
/// fits keep away from such numbers. It says nothing of where the simulation would have been.
inline constexpr double afterFault = 100;

/// Simulates a segment from its start, shifted by `shift` (by nuisance, in their units), and returns its residuals,
/// (simulated − recorded)/floor of the sample (FitTrial::floorAt). After a fault they are afterFault.
std::vector<double> residualsOf(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                const std::vector<double>& shift);

/// The same for a start near one whose residuals are `here`. A servo forgets how it began: once both motions have been
/// one for a while, the rest of the segment is `here` and is not simulated.
std::vector<double> residualsBeside(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                    const std::vector<double>& shift, std::span<const double> here);

}  // namespace btr
