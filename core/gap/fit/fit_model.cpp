#include "core/gap/fit/fit_model.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/unit_at.h"
#include "core/sim/world/scene_build.h"

namespace btr {

SimulatorSpec FitModel::simulator(const FitProblem& problem, std::span<const double> numbers) const {
  SimulatorSpec spec = problem.given;
  std::vector<PlacedEffect> placed = effects;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& parameter = parameters[i];
    const double value = parameter.inRange(numbers[i]);
    if (parameter.effect < 0)
      spec.values[parameter.name] = value;
    else
      placed[static_cast<std::size_t>(parameter.effect)].parameters[parameter.name] = value;
  }
  spec.effects.insert(spec.effects.end(), placed.begin(), placed.end());
  return spec;
}

PlacedEffect FitModel::fittedEffect(const FitProblem& problem, std::size_t effect) const {
  return simulator(problem).effects[problem.given.effects.size() + effect];
}

std::string FitModel::text() const {
  std::string text;
  for (const PlacedEffect& effect : effects) text += (text.empty() ? "" : " + ") + effect.text();
  return text;
}

double FitParameter::inRange(double value) const {
  const double middle = (minimum + maximum) / 2;
  return std::clamp(goesRound ? middle + std::remainder(value - middle, 2 * M_PI) : value, minimum, maximum);
}

namespace {

FitParameter fitParameter(const Parameter& p, int index) {
  FitParameter fit{p.name,    p.unit,    index, p.neutral.value_or(p.byDefault),
                   p.minimum, p.maximum, 1,     p.neutral.has_value()};
  fit.goesRound = !p.neutral && p.unit == "rad" && std::abs(p.maximum - p.minimum - 2 * M_PI) < 1e-3;
  fit.scale = p.neutral ? std::abs(p.byDefault - *p.neutral) : std::abs(p.byDefault) / 2;
  if (fit.scale <= 0) fit.scale = (p.maximum - p.minimum) / 10;
  return fit;
}

bool isWhole(const Parameter& p) { return p.integer || !p.choices.empty(); }

}  // namespace

std::vector<FitParameter> fitParameters(const std::vector<Parameter>& declared, int index) {
  std::vector<FitParameter> list;
  for (const Parameter& p : declared)
    if (!isWhole(p) && !p.refines) list.push_back(fitParameter(p, index));
  return list;
}

FitModel FitModel::with(const FitProblem& problem, const PlacedEffect& effect) const {
  FitModel model = *this;
  const auto plugin = problem.library.make(effect.effect);
  const auto numbers = resolve(plugin->parameters(), effect.parameters, "effect " + effect.effect);
  const int index = static_cast<int>(model.effects.size());
  model.effects.push_back(effect);
  std::vector<Parameter> declared = plugin->parameters();
  for (std::size_t i = 0; i < declared.size(); ++i) {
    model.effects.back().parameters[declared[i].name] = numbers[i];
    declared[i] = inProportion(problem, effect.at, declared[i]);
  }
  for (FitParameter& parameter : fitParameters(declared, index)) {
    if (const Parameter* known = find(declared, parameter.name))
      parameter.unit = unitAt(problem.scene, problem.models, effect.at, *known);
    model.parameters.push_back(parameter);
    model.values.push_back(model.effects.back().parameters.at(parameter.name));
  }
  return model;
}

FitModel FitModel::withFixed(const FitProblem& problem, const PlacedEffect& effect) const {
  FitModel model = with(problem, effect);
  model.parameters.resize(parameters.size());
  model.values.resize(values.size());
  return model;
}

FitModel FitModel::refined(const FitProblem& problem, std::size_t effect) const {
  FitModel model = *this;
  const PlacedEffect& placed = effects[effect];
  const auto isOfIt = [&](const FitParameter& p) { return p.effect == static_cast<int>(effect); };
  for (const Parameter& p : problem.library.make(placed.effect)->parameters()) {
    const auto isIt = [&](const FitParameter& known) { return isOfIt(known) && known.name == p.name; };
    if (!p.refines || isWhole(p) || std::ranges::any_of(model.parameters, isIt)) continue;
    FitParameter detail = fitParameter(p, static_cast<int>(effect));
    detail.unit = unitAt(problem.scene, problem.models, placed.at, p);
    // An effect's numbers stand together.
    const auto last = std::find_if(model.parameters.rbegin(), model.parameters.rend(), isOfIt).base();
    model.values.insert(model.values.begin() + (last - model.parameters.begin()), placed.parameters.at(p.name));
    model.parameters.insert(last, detail);
  }
  return model;
}

FitModel FitModel::without(std::size_t effect) const {
  FitModel model;
  model.effects = effects;
  model.effects.erase(model.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].effect == static_cast<int>(effect)) continue;
    model.parameters.push_back(parameters[i]);
    model.values.push_back(values[i]);
    if (parameters[i].effect > static_cast<int>(effect)) --model.parameters.back().effect;
  }
  return model;
}

FitModel givenModel(const FitProblem& problem) {
  FitModel model;
  const Scene scene = problem.sceneOf(problem.given, 0);
  for (const CalibratePath& path : problem.scene.calibrate) {
    FitParameter parameter{path.path, "", -1, 0, path.minimum, path.maximum, 1, false};
    if (const Parameter* known = find(simulatorParameters(), path.path)) {
      parameter.unit = known->unit;
      parameter.given = valueOf(simulatorParameters(), problem.given.values, path.path);
    } else {
      parameter.given = numberByPath(scene, path.path);
    }
    parameter.given = std::clamp(parameter.given, path.minimum, path.maximum);
    parameter.scale = std::max(0.1 * std::abs(parameter.given), 0.02 * (path.maximum - path.minimum));
    if (!(parameter.scale > 0)) continue;
    model.parameters.push_back(parameter);
    model.values.push_back(parameter.given);
  }
  return model;
}

const Scene& SceneCache::scene(std::span<const double> numbers, std::size_t trial) {
  // Trials with the same settings share scenes.
  std::vector<double> key(numbers.begin(), numbers.end());
  std::size_t first = 0;
  while (problem_.trials[first].recording.settings != problem_.trials[trial].recording.settings) ++first;
  key.push_back(static_cast<double>(first));
  const auto known = scenes_.find(key);
  if (known != scenes_.end()) return known->second;
  if (scenes_.size() > 256) scenes_.clear();
  return scenes_.emplace(key, problem_.sceneOf(model_.simulator(problem_, numbers), trial)).first->second;
}

}  // namespace btr
