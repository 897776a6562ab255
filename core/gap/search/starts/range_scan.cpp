#include "core/gap/search/starts/range_scan.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using Limits = SearchThresholds::Calibration;

/// A number's place in its range, 0 … 1, by order of magnitude where its bounds lie decades apart; and back.
bool byMagnitude(const FitParameter& p, double decade) { return p.minimum > 0 && p.maximum >= decade * p.minimum; }
double placeOf(const FitParameter& p, double value, double decade) {
  return byMagnitude(p, decade) ? std::log(value / p.minimum) / std::log(p.maximum / p.minimum)
                                : (value - p.minimum) / (p.maximum - p.minimum);
}
double valueAt(const FitParameter& p, double place, double decade) {
  return byMagnitude(p, decade) ? p.minimum * std::pow(p.maximum / p.minimum, place)
                                : p.minimum + place * (p.maximum - p.minimum);
}

/// What is replayed: numbers, and where the trials begin with them.
struct Place {
  std::vector<double> values;
  const std::vector<std::vector<double>>* shifts;
};

/// At most `most` segments from all over the recordings: enough to say where a fit may begin. And of a list by segment.
std::size_t strideOf(const FitProblem& problem, std::size_t most) {
  return (problem.segments.size() + most - 1) / most;
}
template <class T>
std::vector<T> everyOf(const std::vector<T>& all, std::size_t stride) {
  std::vector<T> some;
  for (std::size_t i = 0; i < all.size(); i += stride) some.push_back(all[i]);
  return some;
}

/// Each number alone over its range, in the middle of equal parts of it.
void addOneByOne(const FitModel& model, const std::vector<double>& others,
                 const std::vector<std::vector<double>>& shifts, const Limits& limits, double decade,
                 std::vector<Place>& places) {
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    for (int k = 0; k < limits.scanned; ++k) {
      places.push_back({others, &shifts});
      places.back().values[i] = valueAt(model.parameters[i], (k + 0.5) / limits.scanned, decade);
    }
}

/// All together: each number takes each part of its range once (McKay, Beckman and Conover 1979).
void addHypercube(const FitModel& model, const std::vector<std::vector<double>>& shifts, const Limits& limits,
                  double decade, Random& random, std::vector<Place>& places) {
  const std::size_t numbers = model.parameters.size();
  if (numbers < 2) return;
  const std::size_t draws = std::min(limits.hypercubeMost, limits.hypercubePerNumber * numbers), from = places.size();
  places.resize(from + draws, {model.values, &shifts});
  for (std::size_t i = 0; i < numbers; ++i) {
    std::vector<std::size_t> part(draws);
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (std::size_t k = draws; k > 1; --k) std::swap(part[k - 1], part[random.below(k)]);
    for (std::size_t k = 0; k < draws; ++k)
      places[from + k].values[i] = valueAt(
          model.parameters[i], (static_cast<double>(part[k]) + random.uniform()) / static_cast<double>(draws), decade);
  }
}

/// The best that lie apart from each other and from where the fit already is.
std::vector<Place> bestApart(const FitModel& model, const std::vector<Place>& places,
                             const std::vector<JobResult>& replays, const Limits& limits, double decade) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (replays[k].ok()) order.push_back(k);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return replays[k].numbers[0]; });
  std::vector<std::vector<double>> taken{model.values};
  std::vector<Place> best;
  for (const std::size_t k : order) {
    if (best.size() == limits.scanFitted) break;
    const auto isNear = [&](const std::vector<double>& other) {
      double farthest = 0;
      for (std::size_t i = 0; i < other.size(); ++i)
        farthest = std::max(farthest, std::abs(placeOf(model.parameters[i], places[k].values[i], decade) -
                                               placeOf(model.parameters[i], other[i], decade)));
      return farthest < limits.apart;
    };
    if (std::ranges::any_of(taken, isNear)) continue;
    taken.push_back(places[k].values);
    best.push_back(places[k]);
  }
  return best;
}

}  // namespace

void restartFromRanges(const FitService& service, Fit& fit, const std::string& stage, double at) {
  const Limits& limits = service.thresholds().calibration;
  const double decade = service.thresholds().restarts.decade;
  const FitModel& model = fit.model;
  if (model.parameters.empty()) return;
  std::vector<double> given;
  for (const FitParameter& p : model.parameters) given.push_back(p.given);
  // Where the trials begin of themselves: what the fit made of their beginnings belongs to its own numbers.
  const std::vector<std::vector<double>> none;
  Random random = Random::forPurpose(service.options().seed, "calibration ranges");
  std::vector<Place> places;
  addOneByOne(model, given, none, limits, decade, places);
  addOneByOne(model, model.values, fit.shifts, limits, decade, places);
  addHypercube(model, none, limits, decade, random, places);

  const std::size_t stride = strideOf(service.problem(), limits.scannedSegments);
  FitProblem some = service.problem();
  some.segments = everyOf(some.segments, stride);
  some.jobs = 1;
  const std::vector<std::vector<double>> shiftsOfSome = everyOf(fit.shifts, stride);
  // Of the error's size, not its square: what lies apart in one trial must not outweigh all that fits well.
  const auto replays = parallel(
      service.options().jobs, places.size(),
      [&](std::size_t k) {
        FitModel moved = model;
        moved.values = places[k].values;
        return std::vector<double>{
            residualsOf(some, moved, places[k].shifts->empty() ? none : shiftsOfSome).lpNorm<1>()};
      },
      service.reporter(stage, places.size(), at, at));
  std::vector<FitJob> jobs;
  for (const Place& place : bestApart(model, places, replays, limits, decade)) {
    FitModel begun = model;
    begun.values = place.values;
    jobs.push_back({begun, *place.shifts});
  }
  const std::vector<Fit> fits = completed(service.tryFits(jobs, limits.startIterations, stage, at, at));
  if (fits.empty()) return;
  const Fit& best = *std::ranges::min_element(fits, costsLess);
  if (!costsLess(best, fit)) return;
  const std::vector<Fit> goneOn =
      completed(service.tryFits({{best.model, best.shifts}}, limits.iterations, stage, at, at));
  fit = goneOn.empty() || costsLess(best, goneOn[0]) ? best : goneOn[0];
}

}  // namespace btr
