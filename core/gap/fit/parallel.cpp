#include "core/gap/fit/parallel.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/interruptible.h"
#include "core/gap/fit/job_share.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

using Job = std::function<std::vector<double>(std::size_t)>;

/// One job in this process.
JobResult resultOf(const Job& f, std::size_t i) {
  try {
    return {f(i), ""};
  } catch (const InputError& error) {
    return {{}, error.what()};
  } catch (const JobFault&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw JobFault("the analysis ran out of memory; free some, or analyse shorter recordings or with fewer jobs");
  } catch (const std::exception& error) {
    throw JobFault(std::string("a fault of the program ended the analysis: ") + error.what());
  }
}

/// The first byte of a reply says what the rest is.
constexpr char ofNumbers = 'N', ofRefusal = 'R', ofFault = 'F';

std::string packed(const Job& f, std::size_t i) {
  try {
    const JobResult result = resultOf(f, i);
    if (!result.ok()) return ofRefusal + result.refused;
    std::string bytes(1 + result.numbers.size() * sizeof(double), ofNumbers);
    if (!result.numbers.empty()) std::memcpy(bytes.data() + 1, result.numbers.data(), bytes.size() - 1);
    return bytes;
  } catch (const JobFault& fault) {
    return ofFault + std::string(fault.what());
  }
}

JobResult unpacked(const WorkerPool::Reply& reply) {
  if (!reply.ok || reply.bytes.empty())
    throw JobFault("a worker process of the analysis was lost: " + reply.failure +
                   (reply.killed ? ", as by a machine without memory" : ""));
  const std::string rest = reply.bytes.substr(1);
  if (reply.bytes[0] == ofFault) throw JobFault(rest);
  if (reply.bytes[0] == ofRefusal) return {{}, rest};
  JobResult result{std::vector<double>(rest.size() / sizeof(double)), ""};
  if (!rest.empty()) std::memcpy(result.numbers.data(), rest.data(), rest.size());
  return result;
}

/// Of worker processes: of this process, or of all that make this analysis together.
std::vector<WorkerPool::Reply> repliesOf(int jobs, std::size_t count, const Job& f,
                                         const std::function<bool(std::size_t)>& goOn) {
  if (JobShare* share = SharedJobs::now())
    return share->run(
        count, [&](std::size_t i) { return packed(f, i); },
        [&](std::size_t done) {
          Interruptible::ask();
          return !goOn || goOn(done);
        });
  WorkerPool pool(
      std::min(jobs, static_cast<int>(count)), [&](const std::string& job) { return packed(f, std::stoul(job)); },
      longestAnalysisJob_s);
  for (std::size_t i = 0; i < count; ++i) pool.add(i, std::to_string(i));
  constexpr int ask_ms = 100;
  std::vector<WorkerPool::Reply> replies(count);
  for (std::size_t done = 0; done < count;) {
    for (WorkerPool::Ended& ended : pool.wait(ask_ms)) {
      replies[ended.number] = std::move(ended.reply);
      ++done;
      if (goOn && !goOn(done)) throw Cancelled{};
    }
    Interruptible::ask();
  }
  return replies;
}

}  // namespace

std::vector<JobResult> parallel(int jobs, std::size_t count, const Job& f,
                                const std::function<bool(std::size_t)>& goOn) {
  std::vector<JobResult> results;
  if (jobs <= 1 || count <= 1 || WorkerPool::inWorker()) {
    for (std::size_t i = 0; i < count; ++i) {
      Interruptible::ask();
      if (goOn && !goOn(i)) throw Cancelled{};
      results.push_back(resultOf(f, i));
    }
    return results;
  }
  for (const WorkerPool::Reply& reply : repliesOf(jobs, count, f, goOn)) results.push_back(unpacked(reply));
  return results;
}

std::vector<JobResult> inWorkers(const FitProblem& problem, std::size_t count, int replays, const Job& f) {
  constexpr double worthAFork = 5000;  // steps of at least 3 µs; a fork takes about a millisecond
  const bool worth = problem.jobs > 1 && replays * problem.steps() > worthAFork;
  return parallel(worth ? problem.jobs : 1, count, f);
}

std::vector<std::vector<double>> bySegment(const FitProblem& problem, int replays, const Job& f) {
  std::vector<std::vector<double>> numbers;
  for (JobResult& result : inWorkers(problem, problem.segments.size(), replays, f)) {
    if (!result.ok()) throw InputError(result.refused);
    numbers.push_back(std::move(result.numbers));
  }
  return numbers;
}

}  // namespace btr
