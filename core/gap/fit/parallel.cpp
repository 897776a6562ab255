#include <cstring>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/sim/worker_pool.h"
#include "core/spec/cancelled.h"

namespace btr {

std::vector<std::vector<double>> parallel(int jobs, std::size_t count,
                                          const std::function<std::vector<double>(std::size_t)>& f,
                                          const std::function<bool(std::size_t)>& goOn) {
  std::vector<std::vector<double>> results(count);
  if (jobs <= 1 || count <= 1 || WorkerPool::inWorker()) {
    for (std::size_t i = 0; i < count; ++i) {
      if (goOn && !goOn(i)) throw Cancelled{};
      try {
        results[i] = f(i);
      } catch (const std::exception&) {  // as in a worker: the others do not suffer
      }
    }
    return results;
  }
  constexpr double secondsPerJob = 3600;
  const auto work = [&](const std::string& job) {
    const std::vector<double> values = f(std::stoul(job));
    std::string bytes(values.size() * sizeof(double), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
  };
  WorkerPool pool(std::min(jobs, static_cast<int>(count)), work, secondsPerJob);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.push_back(std::to_string(i));
  std::atomic<bool> stop{false};
  const auto replies = pool.run(texts, stop, [&](std::size_t done) {
    if (goOn && !goOn(done)) stop = true;
  });
  if (stop) throw Cancelled{};
  for (std::size_t i = 0; i < count && i < replies.size(); ++i) {
    if (!replies[i].ok) continue;
    results[i].resize(replies[i].bytes.size() / sizeof(double));
    if (!results[i].empty()) std::memcpy(results[i].data(), replies[i].bytes.data(), replies[i].bytes.size());
  }
  return results;
}

std::vector<std::vector<double>> inWorkers(const FitProblem& problem, std::size_t count, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f) {
  constexpr double worthAFork = 5000;  // steps of at least 3 µs; a fork takes about a millisecond
  const bool worth = problem.jobs > 1 && replays * problem.steps() > worthAFork;
  return parallel(worth ? problem.jobs : 1, count, f);
}

std::vector<std::vector<double>> bySegment(const FitProblem& problem, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f) {
  auto results = inWorkers(problem, problem.segments.size(), replays, f);
  // What failed in a worker fails here again, and says why.
  for (std::size_t s = 0; s < results.size(); ++s)
    if (results[s].empty()) results[s] = f(s);
  return results;
}

}  // namespace btr
