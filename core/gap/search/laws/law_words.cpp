#include "core/gap/search/laws/law_words.h"

#include <algorithm>
#include <cmath>

#include "core/gap/search/laws/law_shape.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

std::string unitOfX(LawTerm::On on, const std::string& force) {
  const bool slides = force == "N";
  switch (on) {
    case LawTerm::On::position:
    case LawTerm::On::angle:
      return slides ? "m" : "rad";
    case LawTerm::On::velocity:
      return slides ? "m/s" : "rad/s";
    case LawTerm::On::load:
      return force;
    case LawTerm::On::time:
      return "s";
    case LawTerm::On::nothing:
      break;
  }
  return "";
}

std::string variableText(LawTerm::On on) {
  switch (on) {
    case LawTerm::On::load:
      return "the motor's torque";
    case LawTerm::On::angle:
      return "the angle within a turn";
    default:
      return toText(on);
  }
}

std::string withUnit(double value, const std::string& unit) { return digits(value, 2) + " " + unit; }

/// What the curve does, without a family: where it is largest and smallest.
std::string extremes(const GapReport::LawCurve& curve) {
  const auto [low, high] = std::ranges::minmax_element(curve.y);
  const auto at = [&](auto place) { return curve.x[static_cast<std::size_t>(place - curve.y.begin())]; };
  return "from " + withUnit(*low, curve.unitY) + " at " + withUnit(at(low), curve.unitX) + " to " +
         withUnit(*high, curve.unitY) + " at " + withUnit(at(high), curve.unitX);
}

std::string shapeText(const LawShape& shape, const GapReport::LawCurve& curve) {
  const auto x = [&](double value) { return withUnit(value, curve.unitX); };
  const auto y = [&](double value) { return withUnit(value, curve.unitY); };
  if (shape.family == "detent")
    return "pulls toward " + x(shape.middle) + ", at most " + y(shape.size) + ", within ±" + x(shape.reach) +
           "; like a detent";
  if (shape.family == "cam")
    return "swings by ±" + y(shape.size) + " with a period of " + x(shape.reach) + ", pulls toward " + x(shape.middle) +
           "; like a cam";
  if (shape.family == "hardening spring")
    return "pulls toward " + x(shape.middle) + ", more than in proportion, at most " + y(shape.size) +
           "; like a hardening spring";
  if (shape.family == "dead zone")
    return "hardly anything from " + x(shape.middle - shape.reach) + " to " + x(shape.middle + shape.reach) +
           ", beyond that it pulls back by " + digits(shape.size, 2) + " " + curve.unitY + " per " + curve.unitX +
           "; like a spring with a dead zone";
  if (shape.family == "drift")
    return "changes by " + y(shape.size) + " from " + x(curve.x.front()) + " to " + x(curve.x.back()) +
           "; like a drift";
  return extremes(curve);
}

/// What one curve of the sum does.
std::string clauseOf(const LawTerm& term, const LawShape& shape, const GapReport::LawCurve& curve) {
  if (term.kind == LawTerm::Kind::friction) return extremes(curve);
  return shapeText(shape, curve);
}

}  // namespace

GapReport::MeasuredLaw inReport(const FitProblem& problem, const LearnedLaw& learned, double asGiven, double named) {
  constexpr double normal95 = 1.96;
  GapReport::MeasuredLaw law;
  law.at = learned.law.at;
  const std::string force = forceUnit(problem, law.at);
  std::size_t knots = 0;
  for (const auto& values : learned.law.values) knots += values.size();
  std::size_t parameter = learned.uncertainty.standardError.size() - knots;
  std::vector<std::string> variables, clauses;
  for (std::size_t t = 0; t < learned.law.terms.size(); ++t) {
    const LawTerm& term = learned.law.terms[t];
    const std::vector<double>& values = learned.law.values[t];
    const std::vector<double> errors(
        learned.uncertainty.standardError.begin() + static_cast<std::ptrdiff_t>(parameter),
        learned.uncertainty.standardError.begin() + static_cast<std::ptrdiff_t>(parameter + values.size()));
    parameter += values.size();
    GapReport::LawCurve curve{toText(term.on), unitOfX(term.on, force), force, {}, values, {}, {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      curve.x.push_back(term.knot(static_cast<int>(i)));
      const double half = std::isfinite(errors[i]) ? normal95 * errors[i] : NAN;
      curve.low.push_back(values[i] - half);
      curve.high.push_back(values[i] + half);
    }
    const LawShape shape = shapeOf(term, values, errors);
    if (t == 0) law.family = shape.family;
    variables.push_back(variableText(term.on));
    clauses.push_back(clauseOf(term, shape, curve));
    law.curves.push_back(std::move(curve));
  }
  const bool isFriction =
      std::ranges::all_of(learned.law.terms, [](const LawTerm& term) { return term.kind == LawTerm::Kind::friction; });
  const std::string what = isFriction ? "dry friction" : force == "N" ? "a force" : "a torque";
  law.sentence = what + " at " + law.at + " that depends on ";
  if (variables.size() == 1)
    law.sentence += variables[0] + " alone: " + clauses[0];
  else
    law.sentence += variables[0] + " and on " + variables[1] + ": over " + variables[0] + " " + clauses[0] +
                    ", and over " + variables[1] + " " + clauses[1];
  law.shareOfRest = learned.shareOfRest;
  law.explainedShare = asGiven > 0 ? std::clamp(1 - learned.scored.mean() / asGiven, 0.0, 1.0) : NAN;
  law.pValue = learned.pValue;
  law.error = std::sqrt(learned.scored.mean());
  law.errorWithout = std::sqrt(named);
  return law;
}

}  // namespace btr
