#include "core/run/loop/time_left.h"

#include <algorithm>

namespace btr {

int PlannedWork::measuredAfter(int stage) const {
  const long long wanted = firstGenerations + static_cast<long long>(stage - 1) * nextGenerations;
  return static_cast<int>(std::min<long long>(wanted, totalGenerations));
}

int PlannedWork::stages() const {
  const int after = std::max(0, totalGenerations - firstGenerations);
  return 1 + (after + nextGenerations - 1) / nextGenerations;
}

double PlannedWork::trialsOfAdaptersGeneration(int stage) const {
  return static_cast<double>(adaptersPopulation) * shownIndividuals * stage;
}

double PlannedWork::trialsLeft(int learned, int stage, int adapted) const {
  double trials = static_cast<double>(learnersPopulation) * std::max(0, totalGenerations - learned);
  for (int each = std::max(1, stage); each <= stages(); ++each)
    trials += trialsOfAdaptersGeneration(each) * std::max(0, adaptersGenerations - (each == stage ? adapted : 0));
  return trials;
}

}  // namespace btr
