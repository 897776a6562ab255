#include "core/gap/search/starts/held_numbers.h"

#include <algorithm>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"

namespace btr {

void releaseHeld(const FitService& service, const std::vector<FitParameter>& held, std::vector<Fit>& fits,
                 const std::string& stage, double at) {
  std::vector<FitJob> jobs;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < fits.size() && !held.empty(); ++i) {
    FitModel model = fits[i].model;
    const Eigen::VectorXd here = residualsOf(service.problem(), model, fits[i].shifts);
    for (const FitParameter& p : held) {
      const auto isOne = [&](const FitParameter& other) { return other.effect < 0 && other.name == p.name; };
      if (std::ranges::any_of(fits[i].model.parameters, isOne)) continue;
      FitModel with = model;
      with.parameters.push_back(p);
      with.values.push_back(p.given);
      const auto isSensitive = [&](double by) {
        FitModel moved = with;
        moved.values.back() = std::clamp(p.given + by, p.minimum, p.maximum);
        return (residualsOf(service.problem(), moved, fits[i].shifts) - here).norm() >=
               service.thresholds().calibration.sensitive;
      };
      if (isSensitive(p.scale) || isSensitive(-p.scale)) model = with;
    }
    if (model.parameters.size() == fits[i].model.parameters.size()) continue;
    jobs.push_back({model, fits[i].shifts});
    owner.push_back(i);
  }
  const auto again = service.tryFits(jobs, service.thresholds().calibration.toTheEnd, stage, at, at);
  for (std::size_t k = 0; k < again.size(); ++k)
    if (again[k] && again[k]->cost < fits[owner[k]].cost) fits[owner[k]] = *again[k];
}

}  // namespace btr
