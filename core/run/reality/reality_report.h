#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/learn/policy_gradient.h"
#include "core/store/database.h"

namespace btr {

/// A policy of L2 and what reality said of it so far.
struct PolicyRow {
  Id individual = 0;
  std::vector<double> parameters;
  std::vector<int> changes;  ///< −1, 0, +1: below, at or above the centre; empty where the learner has no centre
  double simulated = 0;
  std::optional<double> fitness;  ///< mean of the values that count
  double standardError = 0;       ///< from repeats; 0 if measured once
  int count = 0;
};

/// One parameter in one iteration.
struct StepRow {
  Parameter parameter;
  double centreBefore = 0;
  std::optional<double> centreAfter;  ///< once the iteration is finished
  ParameterGradient gradient;         ///< its step counts only with centreAfter
  /// Whether the compared groups differ by more than chance would at 5 % (two-sided); false where that is not known.
  bool isSignificant() const { return gradient.pValue && *gradient.pValue < 0.05; }
};

/// One iteration of L2, for a page or a table.
struct RealityReport {
  int stage = 0, number = 0;
  bool isFinished = false;
  bool wasEnded = false;  ///< by a person before everything was measured: no step was taken
  std::vector<PolicyRow> policies;
  /// Empty where policies are not steps up, none or down from a centre (a population, say).
  std::vector<StepRow> steps;
};

/// All iterations of a run, also the one that waits; `genotype` as the run's controller declares it.
std::vector<RealityReport> realityReports(const Database& database, const RunRecord& run,
                                          std::span<const Parameter> genotype);

}  // namespace btr
