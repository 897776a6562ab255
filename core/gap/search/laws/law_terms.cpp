#include "core/gap/search/laws/law_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gap/fit/unit_at.h"

namespace btr {
namespace {

std::string knotName(std::size_t term, int knot) {
  return "curve" + std::to_string(term + 1) + "_" + (knot < 10 ? "0" : "") + std::to_string(knot) + "_nm";
}

}  // namespace

const char* toText(LawTerm::On on) {
  switch (on) {
    case LawTerm::On::position:
      return "position";
    case LawTerm::On::velocity:
      return "velocity";
    case LawTerm::On::load:
      return "load";
    case LawTerm::On::time:
      return "time";
    case LawTerm::On::angle:
      return "angle";
    case LawTerm::On::nothing:
      break;
  }
  return "nothing";
}

PlacedEffect Law::placed() const {
  PlacedEffect effect{measuredLaw, at, {}};
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::string curve = "curve" + std::to_string(t + 1) + "_";
    effect.parameters[curve + "on"] = static_cast<int>(terms[t].on);
    effect.parameters[curve + "kind"] = static_cast<int>(terms[t].kind);
    effect.parameters[curve + "low"] = terms[t].low;
    effect.parameters[curve + "high"] = terms[t].high;
    effect.parameters[curve + "knots"] = terms[t].knots;
    for (int i = 0; i < terms[t].knots; ++i) effect.parameters[knotName(t, i)] = values[t][static_cast<std::size_t>(i)];
  }
  return effect;
}

FitModel Law::in(const FitProblem& problem, const FitModel& model, bool isFixed) const {
  constexpr double most = 1e3;  // typical forces
  FitModel with = model.withFixed(problem, placed());
  if (isFixed) return with;
  const std::string unit = forceUnit(problem, at);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const double least = terms[t].kind == LawTerm::Kind::friction ? 0 : -most * scale;
    for (int i = 0; i < terms[t].knots; ++i) {
      with.parameters.push_back(
          {knotName(t, i), unit, static_cast<int>(with.effects.size()) - 1, 0, least, most * scale, scale, true});
      with.values.push_back(values[t][static_cast<std::size_t>(i)]);
    }
  }
  return with;
}

Law Law::of(const FitModel& fitted) const {
  Law law = *this;
  std::size_t knots = 0;
  for (const LawTerm& term : terms) knots += static_cast<std::size_t>(term.knots);
  auto value = fitted.values.end() - static_cast<std::ptrdiff_t>(knots);
  for (std::vector<double>& list : law.values)
    for (double& each : list) each = *value++;
  return law;
}

std::string forceUnit(const FitProblem& problem, const std::string& at) {
  return unitAt(problem.scene, problem.models, at, {"", "N·m", "value at a knot, N on a slide joint", 0, 1, 0});
}

FitModel withNumbersOf(const FitModel& named, const FitModel& fitted) {
  FitModel model = named;
  std::copy_n(fitted.values.begin(), model.values.size(), model.values.begin());
  return model;
}

double lawValue(const LawTerm& term, const std::vector<double>& values, double x) {
  const double length = term.high - term.low;
  if (term.on == LawTerm::On::angle) x -= length * std::floor((x - term.low) / length);
  const double place = std::clamp((x - term.low) / length, 0.0, 1.0) * (term.knots - 1);
  const auto left = std::min(static_cast<std::size_t>(place), values.size() - 2);
  const double share = place - static_cast<double>(left);
  return (1 - share) * values[left] + share * values[left + 1];
}

}  // namespace btr
