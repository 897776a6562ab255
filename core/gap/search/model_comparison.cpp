#include "core/gap/search/model_comparison.h"

#include <algorithm>
#include <cmath>

namespace btr {

bool isMissed(const Scored& without, const Scored& with, const SearchThresholds::Confirmation& limits) {
  const PairedTest comparison = compare(without.blocks, with.blocks);
  return comparison.t >= limits.missedT && comparison.gain >= limits.leastGain;
}

double imperfectionOf(const Scored& calibrated, const Scored& model, const SearchThresholds::Screening& limits) {
  const double taken = calibrated.mean() - model.mean();
  return taken > 0 ? std::min(limits.imperfect * taken, limits.imperfectMost) : 0;
}

PairedTest besideAFarthestShift(PairedTest comparison, const Scored& without, const Scored& with,
                                const SearchThresholds::Shift& limits) {
  if (without.aligned.ofMost >= limits.inside && with.aligned.ofMost < limits.inside)
    comparison.pValue = std::min(comparison.pValue, compare(without.unshifted, with.blocks).pValue);
  return comparison;
}

bool isWorse(const PairedTest& lost, const SearchThresholds::Rivals& limits) {
  return lost.t >= limits.worseT && lost.gain > limits.worseGain;
}

bool isRefuted(const Scored& other, const Scored& by, const SearchThresholds::Rivals& limits) {
  const PairedTest lost = compare(other.blocks, by.blocks);
  return isWorse(lost, limits) && !(other.mean() <= 1 && lost.gain < limits.gainOfNoise);
}

bool isDistinguished(const Scored& other, const Scored& final, const SearchThresholds::Rivals& limits) {
  return isRefuted(other, final, limits) && other.fit.cost > limits.fitsWorse * final.fit.cost;
}

bool isKnownFromBelow(double without, double fitted, double larger, const SearchThresholds::Confirmation& limits) {
  return std::abs(larger - fitted) < limits.flat * (without - fitted);
}

}  // namespace btr
