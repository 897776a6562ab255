// Structure search: which effects does the simulator lack?
#include "core/gap/search.h"

#include <algorithm>
#include <cmath>

#include "core/spec/random.h"

namespace btr {
namespace {

// What counts as an effect. From the prototype's experience (1 % of everything, 8 % of the excess, t of 2.5, six
// standard errors), kept: fewer conditions let false effects in.
constexpr double leastT = 2.5, leastGain = 0.01, leastShareOfExcess = 0.08, leastErrors = 6;
constexpr double unexplainedExcess = 0.3;  // mean squared error above 1 at which pairs are tried
constexpr std::size_t candidatesToFit = 8, candidatesInPairs = 4;  // half of them are fitted to the end and scored
constexpr int firstIterations = 4, lastIterations = 15, againIterations = 3;
constexpr double hopeless = 2;
constexpr double nothingLeft = 1.03;  // mean squared error at which there is nothing left to explain

std::vector<double> packed(const Fit& fit) {
  std::vector<double> numbers{fit.cost};
  numbers.insert(numbers.end(), fit.model.values.begin(), fit.model.values.end());
  for (const auto& shift : fit.shifts) numbers.insert(numbers.end(), shift.begin(), shift.end());
  return numbers;
}

/// Back from numbers; false if the job failed.
bool unpack(const std::vector<double>& numbers, const FitProblem& problem, Fit& fit) {
  if (numbers.empty()) return false;
  std::size_t at = 0;
  fit.cost = numbers[at++];
  for (double& value : fit.model.values) value = numbers[at++];
  fit.shifts.clear();
  for (const Segment& segment : problem.segments) {
    fit.shifts.emplace_back(numbers.begin() + static_cast<std::ptrdiff_t>(at),
                            numbers.begin() + static_cast<std::ptrdiff_t>(at + segment.nuisances.size()));
    at += segment.nuisances.size();
  }
  return true;
}

class Search {
 public:
  Search(const FitProblem& problem, const SearchOptions& options)
      : problem_(problem), options_(options), finest_s_(0.51 * problem.givenStep_s) {}

  SearchResult run();

 private:
  struct Tried {
    Attempt attempt;
    Fit fit;
    Scored scored;
  };

  std::function<bool(std::size_t)> reporter(const std::string& stage, std::size_t count, double from, double to) const {
    if (!options_.progress) return {};
    return [this, stage, count, from, to](std::size_t done) {
      const double share = count > 0 ? static_cast<double>(done) / static_cast<double>(count) : 1;
      return options_.progress(stage, from + (to - from) * share);
    };
  }

  std::vector<Fit> fitAll(const std::vector<FitModel>& models, const std::vector<std::vector<double>>& shifts,
                          int iterations, const std::string& stage, double from, double to) const;
  std::vector<Scored> scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from, double to) const;
  Scored calibrate() const;
  std::vector<Tried> tryCandidates(const Fit& base, const Linearised& linear, std::size_t toFit,
                                   const std::string& stage, double from, double to);
  bool passes(const Scored& without, const Scored& with, std::size_t newEffect, Comparison& comparison,
              std::string& reason) const;
  bool tryPair(const Scored& current, const std::vector<Tried>& singles, Scored& pair);
  static std::vector<double> sharesOf(const std::vector<Tried>& tried) {
    std::vector<double> shares;
    for (const Tried& each : tried) shares.push_back(each.attempt.share);
    return shares;
  }
  void holdUntold(SearchResult& result) const;
  void prune(SearchResult& result);
  bool contains(const EffectCandidate& candidate, const PlacedEffect& effect) const;
  void findRivals(SearchResult& result);
  void remember(std::vector<Attempt>& attempts, const Attempt& attempt) const;
  GapReport::Step step(const std::string& what, const Scored& scored) const;

  bool needsFinerStep(const Fit& fit) const;
  std::vector<Fit> polish(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                          double to) const;

  FitProblem problem_;  ///< its step may become finer on the way
  const SearchOptions& options_;
  double finest_s_;
  std::vector<Tried> firstStage_;
};

std::vector<Fit> Search::fitAll(const std::vector<FitModel>& models, const std::vector<std::vector<double>>& shifts,
                                int iterations, const std::string& stage, double from, double to) const {
  const auto numbers = parallel(
      options_.jobs, models.size(),
      [&](std::size_t i) {
        return packed(fitModel(problem_, models[i], shifts, {iterations, Fold::all, false}));
      },
      reporter(stage, models.size(), from, to));
  std::vector<Fit> fits;
  for (std::size_t i = 0; i < models.size(); ++i) {
    Fit fit{models[i], {}, INFINITY};
    if (!unpack(numbers[i], problem_, fit)) fit.cost = INFINITY;
    fits.push_back(std::move(fit));
  }
  return fits;
}

std::vector<Scored> Search::scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from,
                                     double to) const {
  const auto numbers = parallel(
      options_.jobs, fits.size(),
      [&](std::size_t i) {
        const Scored scored = crossValidate(problem_, fits[i]);
        std::vector<double> list = scored.blocks;
        list.insert(list.end(), scored.heldOut.begin(), scored.heldOut.end());
        return list;
      },
      reporter(stage, fits.size(), from, to));
  std::vector<Scored> result;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    Scored scored{fits[i], std::vector<double>(static_cast<std::size_t>(problem_.blocks), 1e6),
                  Eigen::VectorXd::Constant(static_cast<Eigen::Index>(problem_.residuals()), 1e3)};
    if (!numbers[i].empty()) {
      const auto blocks = static_cast<std::ptrdiff_t>(scored.blocks.size());
      scored.blocks.assign(numbers[i].begin(), numbers[i].begin() + blocks);
      std::copy(numbers[i].begin() + blocks, numbers[i].end(), scored.heldOut.begin());
    }
    result.push_back(std::move(scored));
  }
  return result;
}

Scored Search::calibrate() const {
  const FitModel given = givenModel(problem_);
  if (given.parameters.empty()) return scoreAsIs(problem_, {given, {}, 0});
  // From the numbers as given, and from two drawn around them.
  std::vector<FitModel> starts{given, given, given};
  Random random = Random::forPurpose(options_.seed, "calibration starts");
  for (std::size_t s = 1; s < starts.size(); ++s)
    for (std::size_t i = 0; i < given.values.size(); ++i) {
      const FitParameter& p = given.parameters[i];
      starts[s].values[i] = std::clamp(p.given + 2 * p.scale * random.uniform(-1, 1), p.minimum, p.maximum);
    }
  std::vector<Fit> fits = fitAll({given}, {}, 15, "calibrating", 0.02, 0.05);
  // ½ a residual is the cost of noise alone: then there is nothing to look for elsewhere.
  if (fits[0].cost > 0.6 * static_cast<double>(problem_.residuals())) {
    const std::vector<Fit> others = fitAll({starts[1], starts[2]}, {}, 10, "calibrating", 0.05, 0.08);
    fits.insert(fits.end(), others.begin(), others.end());
  }
  const auto best =
      std::min_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
  return scoreAll({*best}, "calibrating", 0.08, 0.1)[0];
}

/// True if half the step changes the replay by more than what hides in the noise.
bool Search::needsFinerStep(const Fit& fit) const {
  constexpr double hidden = 0.12;  // noise floors
  FitProblem finer = problem_;
  finer.scene.step_s /= 2;
  const Eigen::VectorXd here = residualsOf(problem_, fit.model, fit.shifts);
  const Eigen::VectorXd change = here - residualsOf(finer, fit.model, fit.shifts);
  const auto count = static_cast<double>(std::max<Eigen::Index>(1, change.size()));
  // Where much is unexplained anyway, the step is not what matters.
  return std::sqrt(change.squaredNorm() / count) > std::max(hidden, 0.05 * std::sqrt(here.squaredNorm() / count));
}

std::vector<Fit> Search::polish(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                                double to) const {
  const auto numbers = parallel(
      options_.jobs, fits.size(),
      [&](std::size_t i) {
        return packed(fitModel(problem_, fits[i].model, fits[i].shifts, {iterations, Fold::all, false}));
      },
      reporter("confirming" + stage, fits.size(), from, to));
  std::vector<Fit> polished = fits;
  for (std::size_t i = 0; i < fits.size(); ++i) unpack(numbers[i], problem_, polished[i]);
  return polished;
}

std::vector<Search::Tried> Search::tryCandidates(const Fit& base, const Linearised& linear, std::size_t toFit,
                                                 const std::string& stage, double from, double to) {
  const std::vector<EffectCandidate> candidates = candidatesFor(problem_, base.model, options_.names);
  const double part = (to - from) / 3;
  const std::vector<Screened> screened = screen(problem_, base, linear, candidates, options_.jobs,
                                                reporter("screening" + stage, candidates.size(), from, from + part));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < screened.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return screened[a].share > screened[b].share; });

  std::vector<Tried> tried;
  for (const std::size_t i : order) {
    Tried each;
    each.attempt.candidate = candidates[i];
    each.attempt.share = screened[i].share;
    each.attempt.excited = screened[i].excited;
    each.attempt.rank = static_cast<int>(tried.size()) + 1;
    each.fit.cost = INFINITY;
    if (!screened[i].starts.empty()) each.attempt.values = screened[i].starts[0].effect;
    if (!each.attempt.excited)
      each.attempt.reason = "the recordings do not feel it at a typical size";
    else
      each.attempt.reason = "screening: would take away " + toText(std::round(1000 * each.attempt.share) / 10) +
                            " % of the squared error, others more";
    tried.push_back(std::move(each));
  }

  // One start each of the most promising, a second one of the best of them.
  const auto fitStarts = [&](const std::vector<std::size_t>& which, std::size_t start, double begin, double end) {
    std::vector<FitModel> models;
    std::vector<std::size_t> owner;
    for (const std::size_t k : which) {
      const Screened& of = screened[order[k]];
      if (start >= of.starts.size()) continue;
      FitModel model = base.model.with(problem_, tried[k].attempt.candidate.placed(of.starts[start].effect));
      std::copy(of.starts[start].parameters.begin(), of.starts[start].parameters.end(), model.values.begin());
      models.push_back(model);
      owner.push_back(k);
    }
    const std::vector<Fit> fits =
        fitAll(models, base.shifts, firstIterations, "fitting candidates" + stage, begin, end);
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (fits[i].cost < tried[owner[i]].fit.cost) {
        tried[owner[i]].fit = fits[i];
        tried[owner[i]].attempt.fitted = true;
      }
  };
  std::vector<std::size_t> promising;
  for (std::size_t k = 0; k < tried.size() && promising.size() < toFit; ++k)
    if (screened[order[k]].excited &&
        screened[order[k]].share >= std::max(0.7 * leastGain, 0.1 * screened[order[0]].share))
      promising.push_back(k);
  fitStarts(promising, 0, from + part, from + 1.6 * part);
  std::stable_sort(promising.begin(), promising.end(),
                   [&](std::size_t a, std::size_t b) { return tried[a].fit.cost < tried[b].fit.cost; });
  if (promising.size() > toFit / 2) promising.resize(toFit / 2);
  fitStarts(promising, 1, from + 1.6 * part, from + 2 * part);
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.fit.cost < b.fit.cost; });

  // The best are fitted to the end, then judged on what they were not fitted to.
  std::vector<Fit> best;
  for (std::size_t k = 0; k < std::min(toFit / 2, tried.size()); ++k)
    // What fits far worse than the best after the first iterations is no rival.
    if (tried[k].attempt.fitted && tried[k].fit.cost <= hopeless * tried[0].fit.cost) best.push_back(tried[k].fit);
  best = polish(best, lastIterations, stage, from + 2 * part, to - part / 2);
  // Effects may need finer steps than the simulator without them: friction at reversals, play.
  while (!best.empty() && problem_.scene.step_s > finest_s_ &&
         std::any_of(best.begin(), best.begin() + std::min<std::ptrdiff_t>(2, std::ssize(best)),
                     [&](const Fit& fit) { return needsFinerStep(fit); })) {
    problem_.scene.step_s /= 2;
    best = polish(best, againIterations, stage, to - part / 2, to - part / 2);
  }
  const std::vector<Scored> scored = scoreAll(best, "confirming" + stage, to - part / 2, to);
  for (std::size_t i = 0; i < scored.size(); ++i) {
    tried[i].fit = best[i];
    tried[i].scored = scored[i];
    tried[i].attempt.scored = true;
  }
  for (Tried& each : tried) {
    if (!each.attempt.fitted) continue;
    each.attempt.values = each.fit.model.simulator(problem_).effects.back().parameters;
  }
  std::stable_sort(tried.begin(), tried.begin() + static_cast<std::ptrdiff_t>(scored.size()),
                   [](const Tried& a, const Tried& b) { return a.scored.mean() < b.scored.mean(); });
  return tried;
}

double largestInErrors(const FitModel& model, const Uncertainty& uncertainty, std::size_t effect) {
  double most = 0;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect != static_cast<int>(effect) || !p.hasNeutral) continue;
    if (uncertainty.standardError[i] > 0)
      most = std::max(most, std::abs(model.values[i] - p.given) / uncertainty.standardError[i]);
  }
  return most;
}

std::string percent(double share) { return toText(std::round(1000 * share) / 10) + " %"; }

bool Search::passes(const Scored& without, const Scored& with, std::size_t newEffect, Comparison& comparison,
                    std::string& reason) const {
  comparison = compare(without.blocks, with.blocks);
  const double excess = excessOf(without);
  const double taken = without.mean() - with.mean();
  if (comparison.t < leastT) {
    reason = "not better on held-out blocks (t = " + toText(std::round(10 * comparison.t) / 10) + ")";
    return false;
  }
  if (comparison.gain < leastGain) {
    reason = "takes only " + percent(comparison.gain) + " of the held-out squared error";
    return false;
  }
  if (excess <= 0 || taken < leastShareOfExcess * excess) {
    reason = "takes only " + percent(excess > 0 ? taken / excess : 0) + " of the excess error";
    return false;
  }
  const Linearised linear = linearise(problem_, with.fit);
  const double errors = largestInErrors(with.fit.model, uncertaintyOf(problem_, with.fit, linear), newEffect);
  if (errors < leastErrors) {
    reason = "its size is only " + toText(std::round(10 * errors) / 10) + " standard errors";
    return false;
  }
  reason = "takes " + percent(comparison.gain) +
           " of the held-out squared error (t = " + toText(std::round(10 * comparison.t) / 10) + ")";
  return true;
}

GapReport::Step Search::step(const std::string& what, const Scored& scored) const {
  GapReport::Step step{what, std::sqrt(scored.mean()), 0};
  double n = 0, square = 0;
  for (const double block : scored.blocks)
    if (block >= 0) {
      ++n;
      square += (block - scored.mean()) * (block - scored.mean());
    }
  if (n > 1 && step.error > 0) step.standardError = std::sqrt(square / (n - 1) / n) / (2 * step.error);
  return step;
}

void Search::remember(std::vector<Attempt>& attempts, const Attempt& attempt) const {
  for (Attempt& known : attempts)
    if (known.candidate.text() == attempt.candidate.text()) {
      if (known.accepted && !attempt.accepted) return;
      const int rank = known.rank;
      const double share = known.share;
      if (attempt.accepted || attempt.scored || !known.scored) {
        const bool keepFirst = !attempt.accepted && known.scored;
        if (!keepFirst) known = attempt;
        known.rank = rank;
        known.share = share;
      }
      return;
    }
  attempts.push_back(attempt);
}

/// Two effects that need each other still show a little alone.
bool promisesAPair(const std::vector<double>& shares) {
  constexpr double least = 0.03;
  return std::any_of(shares.begin(), shares.end(), [](double share) { return share > least; });
}

bool Search::tryPair(const Scored& current, const std::vector<Tried>& singles, Scored& pair) {
  bool found = false;
  for (std::size_t k = 0; k < std::min<std::size_t>(2, singles.size()); ++k) {
    if (!singles[k].attempt.scored) continue;
    const Linearised linear = linearise(problem_, singles[k].fit);
    const auto seconds = tryCandidates(singles[k].fit, linear, candidatesInPairs, ", in pairs", 0.5, 0.6);
    if (seconds.empty() || !seconds[0].attempt.scored) continue;
    Comparison comparison;
    std::string reason;
    // Each of the two must be worth it beside the other, and both together.
    if (!passes(singles[k].scored, seconds[0].scored, seconds[0].fit.model.effects.size() - 1, comparison, reason))
      continue;
    if (!passes(current, seconds[0].scored, seconds[0].fit.model.effects.size() - 2, comparison, reason)) continue;
    if (!found || seconds[0].scored.mean() < pair.mean()) pair = seconds[0].scored;
    found = true;
  }
  return found;
}

/// Calibrated numbers that the recordings do not feel stay as given from here on: each costs a replay a step.
void Search::holdUntold(SearchResult& result) const {
  constexpr double felt = 0.5;  // noise floors, all residuals together, for a typical change
  FitModel& model = result.final.fit.model;
  FitModel kept = model;
  kept.parameters.clear();
  kept.values.clear();
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (result.calibratedLinear.columns.col(column).norm() < felt) continue;
    kept.parameters.push_back(model.parameters[i]);
    kept.values.push_back(model.values[i]);
    columns.push_back(column);
  }
  if (columns.size() == model.parameters.size()) return;
  model = kept;
  Eigen::MatrixXd left(result.calibratedLinear.columns.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    left.col(static_cast<Eigen::Index>(i)) = result.calibratedLinear.columns.col(columns[i]);
  result.calibratedLinear.columns = left;
}

void Search::prune(SearchResult& result) {
  for (bool changed = true; changed && result.final.fit.model.effects.size() > 1;) {
    changed = false;
    std::vector<FitModel> models;
    for (std::size_t i = 0; i < result.final.fit.model.effects.size(); ++i)
      models.push_back(result.final.fit.model.without(i));
    const auto fits = fitAll(models, result.final.fit.shifts, 12, "dropping each in turn", 0.8, 0.83);
    const auto scored = scoreAll(fits, "dropping each in turn", 0.83, 0.86);
    for (std::size_t i = 0; i < scored.size() && !changed; ++i) {
      const Comparison comparison = compare(scored[i].blocks, result.final.blocks);
      if (comparison.t >= 2 && comparison.gain >= leastGain) continue;
      const PlacedEffect& dropped = result.final.fit.model.effects[i];
      result.ladder.push_back(step("− " + dropped.effect + " at " + dropped.at, scored[i]));
      for (Attempt& attempt : result.attempts)
        if (attempt.candidate.effect == dropped.effect && attempt.candidate.at == dropped.at) {
          attempt.accepted = false;
          attempt.reason = "useless once the others were there";
        }
      result.final = scored[i];
      changed = true;
    }
  }
}

/// How many numbers an effect brings.
std::size_t sizeOf(const FitModel& model, std::size_t effect) {
  return static_cast<std::size_t>(std::count_if(model.parameters.begin(), model.parameters.end(),
                                                [&](const auto& p) { return p.effect == static_cast<int>(effect); }));
}

/// True if the candidate is a richer form of the effect at the same place: not a rival of what it contains.
bool Search::contains(const EffectCandidate& candidate, const PlacedEffect& effect) const {
  const std::vector<std::string> simpler = problem_.library.make(candidate.effect)->contains();
  return candidate.at == effect.at && std::find(simpler.begin(), simpler.end(), effect.effect) != simpler.end();
}

void Search::findRivals(SearchResult& result) {
  result.rivalModels.clear();
  for (std::size_t i = 0; i < result.final.fit.model.effects.size(); ++i) {
    const PlacedEffect own = result.final.fit.model.effects[i];
    const std::string ownText = own.effect + " at " + own.at;
    // Its place is offered to the others.
    Scored without = result.calibrated;
    std::vector<Tried> others;
    if (result.final.fit.model.effects.size() == 1) {
      others = firstStage_;
    } else {
      without = scoreAll(fitAll({result.final.fit.model.without(i)}, result.final.fit.shifts, 12, "rivals", 0.86, 0.87),
                         "rivals", 0.87, 0.88)[0];
      others = tryCandidates(without.fit, linearise(problem_, without.fit), candidatesToFit, ", rivals", 0.88, 0.95);
    }
    Found found{own, compare(without.blocks, result.final.blocks), {}};
    for (const Tried& other : others) {
      if (!other.attempt.scored || other.attempt.candidate.text() == ownText) continue;
      const std::size_t place = other.fit.model.effects.size() - 1;
      const Comparison lost = compare(other.scored.blocks, result.final.blocks);
      const double ratio = std::sqrt(other.scored.mean() / std::max(1e-12, result.final.mean()));
      const bool worse = lost.t >= 2 && lost.gain > 0.01;
      const bool simpler = sizeOf(other.fit.model, place) < sizeOf(result.final.fit.model, i);
      const bool clearlyBetter = lost.t <= -leastT && lost.gain < -0.01;
      const bool alreadyThere = std::any_of(
          result.final.fit.model.effects.begin(), result.final.fit.model.effects.end(), [&](const PlacedEffect& e) {
            return e.effect == other.attempt.candidate.effect && e.at == other.attempt.candidate.at;
          });
      if (alreadyThere) continue;
      if ((simpler && !worse) || clearlyBetter) {
        // The simpler of equals, or simply the better one, takes the place.
        for (Attempt& attempt : result.attempts) {
          if (attempt.candidate.text() == ownText) {
            attempt.accepted = false;
            attempt.reason = simpler ? other.attempt.candidate.text() + " is simpler and does as well"
                                     : other.attempt.candidate.text() + " does better";
          }
          if (attempt.candidate.text() == other.attempt.candidate.text()) {
            attempt.accepted = true;
            attempt.reason = simpler ? "simpler than " + ownText + " and not worse" : "better than " + ownText;
          }
        }
        result.final = other.scored;
        return findRivals(result);
      }
      if (!worse && !contains(other.attempt.candidate, own)) {
        found.rivals.push_back({other.attempt.candidate.effect, other.attempt.candidate.at, ratio});
        if (i == 0) result.rivalModels.push_back(other.fit.model);
      }
    }
    if (i < result.effects.size())
      result.effects[i] = found;
    else
      result.effects.push_back(found);
  }
  result.effects.resize(result.final.fit.model.effects.size());
}

SearchResult Search::run() {
  SearchResult result;
  if (options_.progress && !options_.progress("replaying as given", 0)) throw Cancelled{};
  result.given = scoreAsIs(problem_, {givenModel(problem_), {}, 0});
  result.ladder.push_back(step("as given", result.given));
  result.calibrated = calibrate();
  const std::vector<double> inside = blockScores(
      problem_, residualsOf(problem_, result.calibrated.fit.model, result.calibrated.fit.shifts), Fold::all);
  double fitted = 0, blocks = 0;
  for (const double block : inside)
    if (block >= 0) {
      fitted += block;
      ++blocks;
    }
  if (problem_.window_s == 0 && blocks > 0 && result.calibrated.mean() > 1.5 * fitted / blocks &&
      result.calibrated.mean() > 1.3) {
    result.unstable = true;
    return result;
  }
  // Never worse than what was given.
  if (result.calibrated.mean() >= result.given.mean()) result.calibrated = result.given;
  result.ladder.push_back(step("calibrated", result.calibrated));
  result.calibratedLinear = linearise(problem_, result.calibrated.fit);
  result.calibratedUncertainty = uncertaintyOf(problem_, result.calibrated.fit, result.calibratedLinear);
  result.final = result.calibrated;
  holdUntold(result);

  Linearised linear = result.calibratedLinear;
  for (int stage = 0; stage < options_.maximumEffects; ++stage) {
    if (result.final.mean() < nothingLeft) break;
    const double from = 0.1 + 0.7 * stage / options_.maximumEffects, to = from + 0.7 / options_.maximumEffects;
    const double step_s = problem_.scene.step_s;
    auto tried = tryCandidates(result.final.fit, linear, candidatesToFit,
                               stage == 0 ? "" : ", effect " + std::to_string(stage + 1), from, to);
    if (stage == 0) firstStage_ = tried;
    if (problem_.scene.step_s < step_s) result.final = scoreAll({result.final.fit}, "confirming", to, to)[0];
    std::size_t winner = tried.size();
    for (std::size_t k = 0; k < tried.size(); ++k) {
      if (!tried[k].attempt.scored) continue;
      const bool good = passes(result.final, tried[k].scored, tried[k].fit.model.effects.size() - 1,
                               tried[k].attempt.comparison, tried[k].attempt.reason);
      if (good && winner == tried.size()) winner = k;
      if (good && winner != k) tried[k].attempt.reason = tried[winner].attempt.candidate.text() + " does better";
    }
    if (winner < tried.size()) tried[winner].attempt.accepted = true;
    for (const Tried& each : tried) remember(result.attempts, each.attempt);
    if (winner < tried.size()) {
      result.final = tried[winner].scored;
      result.ladder.push_back(step("+ " + tried[winner].attempt.candidate.text(), result.final));
    } else if (Scored pair; static_cast<int>(result.final.fit.model.effects.size()) + 2 <= options_.maximumEffects &&
                            excessOf(result.final) > unexplainedExcess && promisesAPair(sharesOf(tried)) &&
                            tryPair(result.final, tried, pair)) {
      result.final = pair;
      const auto& effects = pair.fit.model.effects;
      std::string what = "+";
      for (std::size_t i = effects.size() - 2; i < effects.size(); ++i) {
        what += " " + effects[i].effect + " at " + effects[i].at + (i + 1 < effects.size() ? " and" : "");
        for (Attempt& attempt : result.attempts)
          if (attempt.candidate.effect == effects[i].effect && attempt.candidate.at == effects[i].at) {
            attempt.accepted = true;
            attempt.reason = "needed together with another";
          }
      }
      result.ladder.push_back(step(what, result.final));
      ++stage;
    } else {
      break;
    }
    linear = linearise(problem_, result.final.fit);
  }
  prune(result);
  findRivals(result);
  result.step_s = problem_.scene.step_s;
  result.finalLinear = linearise(problem_, result.final.fit);
  result.finalUncertainty = uncertaintyOf(problem_, result.final.fit, result.finalLinear);
  return result;
}

}  // namespace

double excessOf(const Scored& scored) { return std::max(0.0, scored.mean() - 1); }

SearchResult searchEffects(const FitProblem& problem, const SearchOptions& options) {
  return Search(problem, options).run();
}

}  // namespace btr
