#pragma once
#include <string>
#include <vector>

#include "core/gap/search/laws/law_terms.h"

namespace btr {

/// A known shape in the place of a curve.
struct LawShape {
  std::string family;  ///< "detent", "cam", "hardening spring", "dead zone", "drift"; "": none fits as well
  double fit = 0;      ///< 1 − weighted squared deviation / weighted variance of the curve
  double middle = 0;   ///< toward which it pulls, or the middle of what is free [unit of x]
  double reach = 0;    ///< of a detent: half its width; of a cam: its period; of a dead zone: half of what is free
  double size = 0;     ///< largest force of a detent or cam, stiffness of a dead zone beyond it
};

/// The shape that fits a curve as well as its own scatter asks, the simplest of those. `error`: of each value, 1 σ.
LawShape shapeOf(const LawTerm& term, const std::vector<double>& values, const std::vector<double>& error);

}  // namespace btr
