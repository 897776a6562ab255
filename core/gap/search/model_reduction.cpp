#include "core/gap/search/model_reduction.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/siblings.h"

namespace btr {
namespace {

/// An effect whose sizes are all at their neutral values is not there: no comparison of fits, rough as they may be,
/// makes it another physics.
bool isNeutral(const FitModel& model, std::size_t effect) {
  constexpr double close = 1e-6;  // typical changes
  bool hasSize = false;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect != static_cast<int>(effect) || !p.hasNeutral) continue;
    hasSize = true;
    if (std::abs(model.values[i] - p.given) > close * p.scale) return false;
  }
  return hasSize;
}

/// An effect that another one of the model needs.
bool isNeeded(const FitProblem& problem, const std::vector<PlacedEffect>& effects, std::size_t which) {
  return std::ranges::any_of(effects, [&](const PlacedEffect& other) {
    return std::ranges::count(problem.library.make(other.effect)->needs(), effects[which].effect) > 0;
  });
}

void dropNeutral(const FitService& service, Selection& selection) {
  for (std::size_t i = selection.final.fit.model.effects.size(); i-- > 0;) {
    const Fit& fit = selection.final.fit;
    if (!isNeutral(fit.model, i)) continue;
    const std::string dropped = fit.model.effects[i].text();
    const Fit without{fit.model.without(i), fit.shifts, fit.cost};
    const Scored scored = service.scoreAll({without}, "dropping each in turn", 0.86, 0.86)[0];
    conclude(selection.attempts, dropped, false, "fitted to nothing beside the others");
    selection.take(scored, "− " + dropped);
  }
}

/// Whether a model that has fewer names or numbers may stand for `final`.
bool doesAsWell(const Scored& simpler, const Scored& final, const Scored& calibrated, const SearchThresholds& limits) {
  const double more = simpler.mean() - final.mean();
  return more < imperfectionOf(calibrated, final, limits.screening) ||
         more < limits.rivals.ofMuchLeft * excessOf(final) ||
         !isWorse(compare(simpler.blocks, final.blocks), limits.rivals);
}

/// Each of an effect's sizes, one after another, at what does best over all that its range holds: what was another
/// effect's share may be hundreds of times what it had.
FitModel withSizesScanned(const FitService& service, FitModel model, std::size_t effect,
                          const std::vector<std::vector<double>>& shifts) {
  const SearchThresholds::Merging& limits = service.thresholds().merging;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect != static_cast<int>(effect) || !p.hasNeutral) continue;
    std::vector<double> places{model.values[i]};
    const double side = model.values[i] < p.given ? -1 : 1;
    for (double size = limits.smallest; size < limits.largest; size *= limits.ratio)
      if (const double place = p.given + side * size * p.scale; place > p.minimum && place < p.maximum)
        places.push_back(place);
    const auto costs = parallel(service.options().jobs, places.size(), [&](std::size_t k) {
      FitModel moved = model;
      moved.values[i] = places[k];
      return std::vector<double>{residualsOf(service.problem(), moved, shifts).squaredNorm()};
    });
    std::size_t best = 0;
    for (std::size_t k = 1; k < places.size(); ++k)
      if (costs[k].ok() && (!costs[best].ok() || costs[k].numbers[0] < costs[best].numbers[0])) best = k;
    model.values[i] = places[best];
  }
  return model;
}

/// The two effects of the model of which the second is a simpler form of the first, at one place.
std::optional<std::pair<std::size_t, std::size_t>> twoNames(const FitProblem& problem, const FitModel& model) {
  for (std::size_t rich = 0; rich < model.effects.size(); ++rich) {
    const std::vector<std::string> simpler = problem.library.make(model.effects[rich].effect)->contains();
    for (std::size_t i = 0; i < model.effects.size(); ++i)
      if (model.effects[i].at == model.effects[rich].at && std::ranges::count(simpler, model.effects[i].effect) > 0)
        return std::pair(rich, i);
  }
  return std::nullopt;
}

}  // namespace

void mergeForms(const FitService& service, Selection& selection, const Scored& calibrated) {
  constexpr const char* stage = "merging two names";
  while (const auto names = twoNames(service.problem(), selection.final.fit.model)) {
    const Fit& fit = selection.final.fit;
    const auto [rich, simple] = *names;
    const std::string richText = fit.model.effects[rich].text(), simpleText = fit.model.effects[simple].text();
    const FitModel alone = withSizesScanned(service, fit.model.without(simple), rich - (simple < rich), fit.shifts);
    const std::optional<Scored> scored =
        service.tryScored({alone, fit.shifts}, service.thresholds().calibration.toTheEnd, stage, 0.8);
    if (!scored || !doesAsWell(*scored, selection.final, calibrated, service.thresholds())) return;
    conclude(selection.attempts, simpleText, false, richText + " has it as a part, and does as well alone");
    selection.take(*scored, richText + " and " + simpleText + " → " + richText);
  }
}

void dropRedundant(FitService& service, Selection& selection, const Scored& calibrated) {
  dropNeutral(service, selection);
  const auto stays = [&](const Scored& without) {
    const double imperfection = imperfectionOf(calibrated, selection.final, service.thresholds().screening);
    return without.mean() - selection.final.mean() > imperfection &&
           isMissed(without, selection.final, service.thresholds().confirmation);
  };
  for (bool changed = true; changed && selection.final.fit.model.effects.size() > 1;) {
    changed = false;
    std::vector<FitJob> jobs;
    for (std::size_t i = 0; i < selection.final.fit.model.effects.size(); ++i)
      jobs.push_back({selection.final.fit.model.without(i), selection.final.fit.shifts});
    auto scored = service.fitAndScore(jobs, selection.final.fit, "dropping each in turn", 0.8, 0.86);
    for (std::size_t i = 0; i < scored.size() && !changed; ++i) {
      if (isNeeded(service.problem(), selection.final.fit.model.effects, i) || stays(scored[i])) continue;
      service.bringToStep(scored[i], "dropping each in turn", 0.86);
      if (stays(scored[i])) continue;
      const std::string dropped = selection.final.fit.model.effects[i].text();
      conclude(selection.attempts, dropped, false, "useless once the others were there");
      selection.take(scored[i], "− " + dropped);
      changed = true;
    }
  }
}

/// The simpler effects of a richer one, side by side, where they have fewer numbers and do as well: friction that was
/// allowed to differ by direction and does not is dry and viscous friction. As little as effects may leave for not
/// being the plant's in every detail is no difference by direction either.
bool takeApart(const FitService& service, Selection& selection, const Scored& calibrated) {
  bool taken = false;
  const FitProblem& problem = service.problem();
  for (std::size_t i = 0; i < selection.final.fit.model.effects.size();) {
    const FitModel& whole = selection.final.fit.model;
    const PlacedEffect own = whole.effects[i];
    const std::vector<std::string> names = problem.library.make(own.effect)->contains();
    FitModel parts = whole.without(i);
    const std::size_t others = parts.effects.size();
    std::vector<EffectCandidate> added;
    for (const std::string& name : names)
      for (const EffectCandidate& candidate : service.candidatesBeside(parts, {name}))
        if (candidate.at == own.at && service.isConsidered(name)) {
          parts = parts.with(problem, candidate.placed({}));
          added.push_back(candidate);
        }
    if (added.size() < 2 || parts.parameters.size() >= whole.parameters.size() ||
        static_cast<int>(findingsIn(problem.library, parts.effects)) > service.options().maximumEffects) {
      ++i;
      continue;
    }
    const std::optional<Scored> apart = service.tryScored(
        {parts, selection.final.fit.shifts}, service.thresholds().rivals.apartIterations, "taking apart", 0.86);
    if (!apart || !doesAsWell(*apart, selection.final, calibrated, service.thresholds())) {
      ++i;
      continue;
    }
    const Scored& scored = *apart;
    const std::string ownText = own.text();
    std::string what = ownText + " →";
    for (std::size_t k = 0; k < added.size(); ++k) {
      what += (k ? " and " : " ") + added[k].text();
      selection.remember(accepted(added[k], problem, scored.fit.model, others + k,
                                  compare(calibrated.blocks, scored.blocks),
                                  "with the others simpler than " + ownText + " and not worse"));
    }
    conclude(selection.attempts, ownText, false, "its simpler forms together do as well");
    selection.take(scored, what);
    taken = true;
    i = 0;
  }
  return taken;
}

}  // namespace btr
