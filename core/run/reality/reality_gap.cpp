#include "core/run/reality/reality_gap.h"

#include <algorithm>
#include <cmath>

#include "core/gap/report/report_figures.h"
#include "core/spec/figures.h"

namespace btr {

double gapOf(std::span<const double> real, std::span<const double> simulated, GapNorm norm) {
  double sum = 0, squares = 0, largest = 0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    const double difference = std::abs(real[i] - simulated[i]);
    sum += difference;
    squares += difference * difference;
    largest = std::max(largest, difference);
  }
  if (real.empty()) return 0;
  const auto count = static_cast<double>(real.size());
  switch (norm) {
    case GapNorm::meanAbsolute:
      return sum / count;
    case GapNorm::rootMeanSquare:
      return std::sqrt(squares / count);
    case GapNorm::maximum:
      break;
  }
  return largest;
}

double gapStandardError(const std::vector<RealFitness>& real) {
  double variance = 0;
  for (const RealFitness& r : real)
    if (r.count > 1) variance += r.standardDeviation * r.standardDeviation / r.count;
  return real.empty() ? 0 : std::sqrt(variance) / static_cast<double>(real.size());
}

std::vector<RealFitness> realFitness(const std::vector<MeasurementTask>& tasks,
                                     const std::vector<MeasurementRecord>& measurements, int stage) {
  std::vector<RealFitness> all;
  for (const MeasurementTask& task : tasks) {
    if (task.stage > stage) continue;
    std::vector<double> values;
    for (const MeasurementRecord& m : measurements)
      if (m.individual == task.individual && !m.isVoid) values.push_back(m.value);
    if (values.empty()) continue;
    RealFitness r;
    r.individual = task.individual;
    r.stage = task.stage;
    r.heldOut = task.heldOut;
    r.iteration = task.iteration;
    r.count = static_cast<int>(values.size());
    for (double v : values) r.mean += v;
    r.mean /= r.count;
    for (double v : values) r.standardDeviation += (v - r.mean) * (v - r.mean);
    r.standardDeviation = r.count > 1 ? std::sqrt(r.standardDeviation / (r.count - 1)) : 0;
    all.push_back(std::move(r));
  }
  return all;
}

bool isOver(const MeasurementTask& task, const std::vector<RealityIteration>& finished) {
  return std::any_of(finished.begin(), finished.end(),
                     [&](const RealityIteration& i) { return i.stage == task.stage && i.number == task.iteration; });
}

bool isSettled(const MeasurementTask& task, const std::vector<MeasurementRecord>& measurements) {
  const auto values = std::count_if(measurements.begin(), measurements.end(),
                                    [&](const MeasurementRecord& m) { return m.individual == task.individual; });
  return values >= task.wantedRepeats;
}

std::string reasonOf(const MeasurementTask& task, const std::string& unit, bool withNumbers) {
  if (task.iteration > 0) return "policy of L2";
  if (task.disagreement) {
    const std::string why = "candidate simulators disagree";
    if (!withNumbers) return why;
    return why + ": ± " + brief(*task.disagreement) + (unit.empty() ? "" : " " + unit) + " over " +
           std::to_string(task.candidates);
  }
  return withNumbers && task.rank > 0 ? "best, rank " + std::to_string(task.rank) : "best";
}

}  // namespace btr
