#pragma once
#include <functional>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// Mean squared error of each trial [noise floors²], its initial states fitted, nothing else.
std::vector<double> errorsByTrial(const FitProblem& problem, const FitModel& model, int iterations);

/// Trials that stand far outside the others under a fit to the best part of all (least trimmed squares over trials:
/// Rousseeuw, J. Am. Stat. Assoc. 79 (1984) 871, by concentration steps from several starts). Those that merely show
/// more of something that is missing stand outside, too. None where there are too few trials, or all are at the noise.
std::vector<std::size_t> outlyingTrials(const FitProblem& problem, const SearchResult& found, int jobs,
                                        const SearchThresholds::Trials& limits);

/// Which of the errors stand outside: far from the median, and by a robust z of their logarithms.
std::vector<std::size_t> outlying(const std::vector<double>& errors, const SearchThresholds::Trials& limits);

/// What a trial would need to agree with a simulator that the others made: another value of one number (of its own
/// settings, of those that are calibrated, of its position sensors), else other values of all that is fitted, else
/// nothing that the simulator has. `ready` makes a fit problem of recordings. What nothing explains is set aside only
/// if it goes no farther and no faster than the others (without the other `suspects`): else it may show what they do
/// not.
GapReport::Disagreement explainDisagreement(const FitProblem& problem, std::size_t trial,
                                            const std::vector<std::size_t>& suspects, const FitModel& others,
                                            double errorOfOthers,
                                            const std::function<FitProblem(const std::vector<Recording>&)>& ready,
                                            const SearchThresholds::Trials& limits);

}  // namespace btr
