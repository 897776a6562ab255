#include "core/gap/evaluate_ahead.h"

#include <algorithm>

namespace btr {

void EvaluateAhead::PrepareForEvaluation(bool jacobians, bool /*newPoint*/) {
  std::vector<Asked*> open(problem_.segments.size(), nullptr);
  std::size_t columns = 1;
  for (Asked& asked : costs_)
    if (asked.cost->simulatesAt(asked.blocks.data(), jacobians)) {
      open[asked.cost->segment()] = &asked;
      if (jacobians) columns = std::max(columns, 1 + asked.cost->parameters());
    }
  if (std::all_of(open.begin(), open.end(), [](const Asked* asked) { return !asked; })) return;
  const auto numbers = bySegment(problem_, static_cast<int>(columns), [&](std::size_t s) {
    return open[s] ? open[s]->cost->simulated(open[s]->blocks.data(), jacobians) : std::vector<double>{};
  });
  for (std::size_t s = 0; s < open.size(); ++s)
    if (open[s]) open[s]->cost->take(open[s]->blocks.data(), numbers[s]);
}

}  // namespace btr
