#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// The effect that holds what was learned without a name (plugins/effects/mechanism/measured_law.cpp). No search offers
/// it.
inline constexpr const char* measuredLaw = "measured_law";
inline constexpr std::size_t mostLawTerms = 2;
inline constexpr int mostLawKnots = 25;

/// One curve of it, without its values: what it depends on, and where its knots are.
struct LawTerm {
  enum class On { nothing, position, velocity, load, time, angle };  ///< as the effect numbers them
  enum class Kind { force, friction };
  On on = On::nothing;
  Kind kind = Kind::force;
  double low = 0, high = 1;  ///< rad, rad/s, N·m or s; on a slide joint m, m/s, N
  int knots = 2;
  double knot(int index) const { return low + (high - low) * index / (knots - 1); }
};

const char* toText(LawTerm::On on);

/// Curves and their values at one joint.
struct Law {
  std::string at;    ///< "ROBOT.JOINT"
  double scale = 1;  ///< a typical force there [N·m or N]
  std::vector<LawTerm> terms = {};
  std::vector<std::vector<double>> values = {};  ///< by term and knot [N·m or N]

  PlacedEffect placed() const;
  /// The model with the law as its last effect. Its knots are fitted; with `isFixed` its numbers stay.
  FitModel in(const FitProblem& problem, const FitModel& model, bool isFixed = false) const;
  /// The same law with the values that a fit of in() found.
  Law of(const FitModel& fitted) const;
};

/// The unit of a force at a joint, "N·m" or "N".
std::string forceUnit(const FitProblem& problem, const std::string& at);
/// `named` with the numbers that it has in `fitted`, a model with more (a law's knots) behind them.
FitModel withNumbersOf(const FitModel& named, const FitModel& fitted);
/// The value of one curve at x.
double lawValue(const LawTerm& term, const std::vector<double>& values, double x);

}  // namespace btr
