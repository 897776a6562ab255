#include "core/gap/search/rivals/rival_intervals.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/gap_report.h"

#include <algorithm>

namespace btr {
namespace {

/// Whether two models mean the same number: the scene's by its path, an effect's by effect, place and name.
bool isSame(const FitModel& a, const FitParameter& p, const FitModel& b, const FitParameter& q) {
  if (p.name != q.name || (p.effect < 0) != (q.effect < 0)) return false;
  if (p.effect < 0) return true;
  const PlacedEffect& first = a.effects[static_cast<std::size_t>(p.effect)];
  const PlacedEffect& second = b.effects[static_cast<std::size_t>(q.effect)];
  return first.effect == second.effect && first.at == second.at;
}

}  // namespace

GapReport::Interval interval95(const FitModel& model, const Uncertainty& uncertainty, std::size_t parameter) {
  const FitParameter& p = model.parameters[parameter];
  const double value = model.values[parameter], half = uncertainty.half95(parameter);
  return {std::max(p.minimum, value - half), std::min(p.maximum, value + half)};
}

GapReport::Interval intervalAmongRivals(const SearchResult& found, std::size_t parameter) {
  const FitModel& model = found.final.fit.model;
  GapReport::Interval all = interval95(model, found.finalUncertainty, parameter);
  bool anyHasIt = false;
  for (const Found& effect : found.effects)
    for (std::size_t r = 0; r < effect.rivalFits.size(); ++r) {
      const FitModel& rival = effect.rivalFits[r].model;
      const auto same = std::ranges::find_if(rival.parameters, [&](const FitParameter& q) {
        return isSame(model, model.parameters[parameter], rival, q);
      });
      if (same == rival.parameters.end()) continue;
      const auto place = static_cast<std::size_t>(same - rival.parameters.begin());
      const GapReport::Interval other = interval95(rival, effect.rivalUncertainties[r], place);
      all = {std::min(all.low, other.low), std::max(all.high, other.high)};
      anyHasIt = true;
    }
  return anyHasIt ? all : GapReport::Interval::none();
}

}  // namespace btr
