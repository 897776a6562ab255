#pragma once
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/gap/fit/fit_problem.h"

namespace btr {

/// What a job gave: numbers, or why its input cannot be simulated (the text of an InputError).
struct JobResult {
  std::vector<double> numbers;
  std::string refused;
  bool ok() const { return refused.empty(); }
};

/// A job that ran out of memory, met a fault of the program or lost its worker process. Whatever is concluded without
/// its numbers would rest on a failure, so the analysis ends with this. what() is a sentence for people.
class JobFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs f(0 … count−1) in `jobs` worker processes and returns what each gave, in order. An InputError of f is a result
/// (`refused`); anything else that it throws ends in a JobFault, of the first job that failed. The same with one job,
/// which runs in this process. Where several processes analyse together (job_share.h) the jobs are divided among all:
/// whether there is a call, and of how many jobs, may hang on nothing but the input, the seed and `jobs`. Throws
/// Cancelled when `goOn` says no, which is told how many are done, or an Interruptible of this thread.
std::vector<JobResult> parallel(int jobs, std::size_t count, const std::function<std::vector<double>(std::size_t)>& f,
                                const std::function<bool(std::size_t)>& goOn = {});
/// parallel() in the problem's worker processes where about `replays` replays of everything are worth them.
std::vector<JobResult> inWorkers(const FitProblem& problem, std::size_t count, int replays,
                                 const std::function<std::vector<double>(std::size_t)>& f);
/// f of every segment, in the problem's worker processes where about `replays` replays of everything are worth them.
/// Throws the InputError of the first segment that is refused.
std::vector<std::vector<double>> bySegment(const FitProblem& problem, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f);

}  // namespace btr
