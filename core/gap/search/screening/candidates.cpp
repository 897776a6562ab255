#include "core/gap/search/screening/candidates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/joint_pace.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/search/laws/law_terms.h"
#include "core/gap/search/thresholds.h"
#include "core/plugin/joint_effect.h"
#include "core/sim/effect_places.h"

namespace btr {
namespace {

/// Whole numbers are tried one after another, numbers without a neutral value at a few places of their range.
std::vector<double> triesOf(const Parameter& p, const SearchThresholds::Candidates& limits) {
  if (p.integer || !p.choices.empty()) {
    // Small numbers one by one, larger ones by a quarter: a fit goes on to their neighbours.
    std::vector<double> tries;
    // The same numbers whatever the recordings allow.
    for (double value = std::min(1.0, std::ceil(p.minimum));
         value <= p.maximum && tries.size() < limits.wholeNumbersMost;
         value = std::max(value + 1, p.integer ? std::round(limits.wholeNumbersWider * value) : 0))
      if (value >= p.minimum) tries.push_back(value);
    return tries;
  }
  const double range = p.maximum - p.minimum;
  if (p.minimum > 0 && p.maximum / p.minimum > limits.wideRange)
    return {p.byDefault, std::max(p.minimum, p.byDefault / limits.aroundDefault),
            std::min(p.maximum, p.byDefault * limits.aroundDefault)};
  std::vector<double> tries{p.byDefault, p.minimum + limits.rangeLow * range, p.minimum + limits.rangeHigh * range};
  // Lengths to either side also near nothing: bodies are as small as a hand and as large as a man.
  if (p.unit == "m" && p.minimum < 0 && p.maximum > 0 && p.byDefault == 0)
    for (const double near : {-range / limits.nearNothing, range / limits.nearNothing}) tries.push_back(near);
  return tries;
}

/// Which of a trial's measured channels is the position of the joint `at`.
std::optional<std::size_t> positionOf(const FitTrial& trial, const std::string& at) {
  for (std::size_t c = 0; c < trial.binding.measured.size(); ++c) {
    if (trial.binding.measured[c].what != Binding::Measured::What::position) continue;
    const auto channel = parseChannel(trial.recording.channels[trial.binding.measured[c].column]);
    if (channel && channel->owner + "." + channel->part == at) return c;
  }
  return {};
}

/// A joint whose drive follows no position has no loop that a sensor could close.
bool hasNoLoop(const FitProblem& problem, const std::string& at) {
  const Scene scene = problem.sceneOf(problem.given, 0);
  for (const SceneRobot& robot : scene.robots)
    for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
      if (at == robot.name + "." + robot.model.joints[j].name)
        return robot.drives[j].kind != Drive::Kind::servo && robot.drives[j].kind != Drive::Kind::dcMotor;
  return false;
}

/// Where a joint's position was in all recordings together [rad or m]; nowhere for what is no measured joint.
Extent positionsOf(const FitProblem& problem, const std::string& at) {
  Extent position;
  for (const FitTrial& trial : problem.trials)
    if (const auto channel = positionOf(trial, at))
      position.add(trial.recording.columns[trial.binding.measured[*channel].column]);
  return position;
}

/// Periods are called so only where the motion passes several of them.
void showPeriods(std::vector<Parameter>& declared, const std::string& periods, const Extent& position,
                 const SearchThresholds::Candidates& limits) {
  const double travel = position.some() ? position.high - position.low : 0;
  for (Parameter& p : declared)
    if (p.name == periods) {
      p.minimum = std::max(p.minimum, travel > 0 ? std::ceil(limits.leastPeriods * 2 * M_PI / travel) : INFINITY);
      p.byDefault = std::max(p.byDefault, p.minimum);
    }
}

/// The ends of a free range lie on either side of the motion's middle, and are looked for first near its ends.
void showEnds(std::vector<Parameter>& declared, const std::vector<std::string>& ends, const Extent& position,
              const SearchThresholds::Candidates& limits) {
  const bool moves = position.some() && position.high > position.low;
  const double middle = (position.low + position.high) / 2, inside = limits.endInside * (position.high - position.low);
  for (Parameter& p : declared) {
    if (p.name != ends.front() && p.name != ends.back()) continue;
    const bool isLower = p.name == ends.front();
    p.minimum = moves ? (isLower ? position.low : middle) : INFINITY;
    if (!moves) continue;
    p.maximum = isLower ? middle : position.high;
    p.byDefault = isLower ? position.low + inside : position.high - inside;
  }
}

/// A joint that stays where it is in each of the recordings, as far as its noise lets see.
bool standsStill(const FitProblem& problem, const std::string& at, const SearchThresholds::Candidates& limits) {
  bool isSeen = false;
  for (const FitTrial& trial : problem.trials) {
    const auto channel = positionOf(trial, at);
    if (!channel) continue;
    isSeen = true;
    Extent position;
    position.add(trial.recording.columns[trial.binding.measured[*channel].column]);
    if (position.high - position.low > limits.standsStill * trial.noiseFloor[*channel]) return false;
  }
  return isSeen;
}

Values neutralValues(const std::vector<Parameter>& declared) {
  Values values;
  for (const Parameter& p : declared) values[p.name] = p.neutral.value_or(p.byDefault);
  return values;
}

/// What keeps a joint where it is may be as large as it likes, and does it only if it is large.
void addHolding(EffectCandidate& candidate) {
  for (const Parameter& p : candidate.declared) {
    if (!p.neutral) continue;
    candidate.variants.push_back(neutralValues(candidate.declared));
    candidate.variants.back()[p.name] = p.maximum;
  }
}

double typicalOf(const Parameter& p, const SearchThresholds::Candidates& limits) {
  const double typical = std::abs(p.byDefault - *p.neutral);
  return typical > 0 ? typical : limits.typicalOfRange * (p.maximum - p.minimum);
}

std::vector<Values> variantsOf(const std::vector<Parameter>& declared, const SearchThresholds::Candidates& limits) {
  Values base = neutralValues(declared);
  const Parameter* const phase = phaseOf(declared);
  std::vector<Values> variants;
  const auto sized = [&](const Parameter& p, double share, double sign, const Values& others) {
    Values values = others;
    values[p.name] = std::clamp(*p.neutral + sign * share * typicalOf(p, limits), p.minimum, p.maximum);
    if (values[p.name] != *p.neutral && std::find(variants.begin(), variants.end(), values) == variants.end())
      variants.push_back(values);
  };
  for (const Parameter& p : declared) {
    if (!p.neutral) continue;
    const bool up = *p.neutral<p.maximum, down = *p.neutral> p.minimum;
    // A linear effect needs one size and sign only, but few are linear: a typical size, both signs, a small one, large
    // ones.
    if (up) sized(p, 1, 1, base);
    if (down) sized(p, 1, -1, base);
    sized(p, limits.smallSize, up ? 1 : -1, base);
    for (const double much : limits.largeSizes) sized(p, much, up ? 1 : -1, base);
    for (const Parameter& other : declared) {
      if (other.neutral || other.refines) continue;
      for (const double value : triesOf(other, limits)) {
        if (value == base[other.name]) continue;
        Values others = base;
        others[other.name] = value;
        sized(p, 1, up ? 1 : -1, others);
        // Of a kind that a drive alone can be, no other one shows the sign.
        if (up && down && other.integer) sized(p, 1, -1, others);
        // A wave of the wrong phase says nothing of its number: with a quarter of a turn more one of the two does.
        if (other.integer && phase) {
          others[phase->name] = base[phase->name] + M_PI / 2;
          sized(p, 1, up ? 1 : -1, others);
        }
        // What a mechanism is built like (where its sensors sit) says nothing of how soft or worn it is.
        if (other.integer && other.maximum - other.minimum <= limits.mostKinds)
          for (const double much : limits.largeSizes) sized(p, much, up ? 1 : -1, others);
      }
    }
  }
  return variants;
}

}  // namespace

const Parameter* phaseOf(const std::vector<Parameter>& declared) {
  const auto fitted = fitParameters(declared, 0);
  const auto phase = std::ranges::find_if(fitted, &FitParameter::goesRound);
  return phase == fitted.end() ? nullptr : find(declared, phase->name);
}

std::vector<EffectCandidate> candidatesFor(const Scene& scene, const EffectLibrary& library,
                                           const std::vector<PlacedEffect>& there,
                                           const std::vector<std::string>& names,
                                           const SearchThresholds::Candidates& thresholds) {
  std::vector<EffectCandidate> candidates;
  for (const std::string& name : names.empty() ? library.names : names) {
    if (name == measuredLaw) continue;
    const auto effect = library.make(name);
    const std::vector<Parameter> declared = effect->parameters();
    for (const std::string& at : effectPlaces(*effect, scene, scene.robots))
      if (std::none_of(there.begin(), there.end(),
                       [&](const PlacedEffect& other) { return other.effect == name && other.at == at; }))
        candidates.push_back({name, at, declared, variantsOf(declared, thresholds)});
  }
  return candidates;
}

std::vector<Parameter> parametersAt(const FitProblem& problem, const std::string& effect, const std::string& at,
                                    const SearchThresholds::Candidates& thresholds) {
  const auto made = problem.library.make(effect);
  std::vector<Parameter> declared = made->parameters();
  for (Parameter& p : declared) {
    p = inProportion(problem, at, p);
    // A period no longer than the scene's step is how the scene itself steps.
    if (p.integer && p.unit == "ms") {
      p.minimum = std::max(p.minimum, std::floor(1000 * problem.givenStep_s) + 1);
      p.byDefault = std::max(p.byDefault, p.minimum);
    }
    if (p.name == closesLoopParameter().name && hasNoLoop(problem, at)) p.maximum = p.byDefault = p.minimum;
  }
  if (const std::string periods = made->periodsPerTurn(); !periods.empty())
    showPeriods(declared, periods, positionsOf(problem, at), thresholds);
  if (const auto ends = made->freeRange(); !ends.empty())
    showEnds(declared, ends, positionsOf(problem, at), thresholds);
  return declared;
}

std::vector<EffectCandidate> candidatesFor(const FitProblem& problem, const FitModel& model,
                                           const std::vector<std::string>& names,
                                           const SearchThresholds::Candidates& thresholds) {
  std::vector<EffectCandidate> candidates = candidatesFor(problem.sceneOf(problem.given, 0), problem.library,
                                                          model.simulator(problem).effects, names, thresholds);
  std::erase_if(candidates, [&](EffectCandidate& candidate) {
    const std::vector<Parameter> shown = parametersAt(problem, candidate.effect, candidate.at, thresholds);
    if (std::ranges::any_of(shown, [](const Parameter& p) { return p.minimum > p.maximum; })) return true;
    const auto numbers = [](const Parameter& p) { return std::tuple(p.minimum, p.maximum, p.byDefault); };
    if (!std::ranges::equal(shown, candidate.declared, {}, numbers, numbers)) {
      candidate.declared = shown;
      candidate.variants = variantsOf(shown, thresholds);
    }
    return false;
  });
  std::map<std::string, bool> isHeld;  // by place: each is looked at once, however many effects it may have
  for (EffectCandidate& candidate : candidates) {
    const auto [place, isNew] = isHeld.emplace(candidate.at, false);
    if (isNew) place->second = standsStill(problem, candidate.at, thresholds);
    if (place->second) addHolding(candidate);
  }
  return candidates;
}

bool isRicher(const EffectLibrary& library, const EffectCandidate& candidate, const PlacedEffect& effect) {
  const std::vector<std::string> simpler = library.make(candidate.effect)->contains();
  return candidate.at == effect.at && std::find(simpler.begin(), simpler.end(), effect.effect) != simpler.end();
}

bool isSimplerForm(const EffectLibrary& library, const EffectCandidate& candidate, const PlacedEffect& effect) {
  return isRicher(library, {effect.effect, effect.at, {}, {}}, candidate.placed({}));
}

Values scaledVariant(const EffectCandidate& candidate, const Values& variant, double step) {
  Values values = variant;
  for (const Parameter& p : candidate.declared)
    if (p.neutral)
      values[p.name] = std::clamp(*p.neutral + step * (variant.at(p.name) - *p.neutral), p.minimum, p.maximum);
  return values;
}

}  // namespace btr
