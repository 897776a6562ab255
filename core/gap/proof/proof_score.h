#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proved_case.h"

namespace btr {

/// A share of cases, or of numbers, with its 95 % interval (Clopper and Pearson 1934).
struct Share {
  int hits = 0, cases = 0;
  double value() const { return cases > 0 ? static_cast<double>(hits) / cases : 0; }
  double low() const;
  double high() const;
  void count(bool hit) {
    ++cases;
    hits += hit;
  }
};

/// Sums over a group of cases.
struct ProofGroup {
  int cases = 0, failed = 0;
  Share falseAlarms, named, alone, bothNamed, location, heldOutNear, confidentlyWrong, unexplained, numbersChanged;
  Share parametersCovered, calibratedCovered;          ///< of numbers, not of cases
  Share parametersAmongRivals, calibratedAmongRivals;  ///< the same
  std::vector<double> heldOut, parameterErrors, calibratedErrors, seconds;
  void add(const ProvedCase& proved, const CaseMarks& marks);
};

/// A bar of the proof: met, missed, or not asked (no case).
struct ProofBar {
  std::string question, wanted, found;
  bool asked = false, met = false;
};

struct ProofScore {
  ProofGroup all;
  std::vector<std::pair<std::string, ProofGroup>> byScene, byKind, byCost;  ///< cost of the dearest hidden effect
  std::map<std::pair<std::string, std::string>, int> confusion;
  std::map<std::pair<std::string, std::string>, int> verdicts;  ///< by kind of case and verdict ("failed": none)
  std::vector<ProofBar> bars;
};
ProofScore score(const std::vector<ProvedCase>& cases);

double middleOf(std::vector<double> values);  ///< not a number for none

}  // namespace btr
