#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "core/gap/fit/fit_problem.h"

namespace btr {

/// Runs f(0 … count−1) in `jobs` worker processes and returns what each gave, in order; a failed one gives an empty
/// vector. Throws Cancelled when `goOn` says no.
std::vector<std::vector<double>> parallel(int jobs, std::size_t count,
                                          const std::function<std::vector<double>(std::size_t)>& f,
                                          const std::function<bool(std::size_t)>& goOn = {});
/// f(0 … count−1) in the problem's worker processes where about `replays` replays of everything are worth them; a
/// failed one gives an empty vector.
std::vector<std::vector<double>> inWorkers(const FitProblem& problem, std::size_t count, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f);
/// f of every segment, in the problem's worker processes where about `replays` replays of everything are worth them.
std::vector<std::vector<double>> bySegment(const FitProblem& problem, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f);

}  // namespace btr
