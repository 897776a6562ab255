#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gap/gap_report.h"
#include "core/gap/proof_answer.h"

namespace btr {

/// A blind case after its seal was opened: the answer, and what the analysis had said. What counts as right stands in
/// tests/prove/README.md.
struct ProvedCase {
  /// How sure the analysis was of a number; `excited` is false where the recordings do not tell it.
  struct Told {
    GapReport::Interval ci95;
    bool excited = true;
    GapReport::Interval amongRivals = GapReport::Interval::none();  ///< see GapReport::Number
  };
  struct Rival {
    std::string effect, at;
    std::string with = {};  ///< not empty: only together with this effect at the same place
  };
  struct Named {
    PlacedEffect placed;
    std::vector<Rival> rivals = {};
    std::map<std::string, Told> told = {};  ///< by parameter
  };
  ConcealedAnswer answer;
  std::string failure;  ///< why there is no verdict; empty: there is one
  std::string verdict;  ///< as in report.json
  std::vector<Named> accepted;
  std::string remainderAt;   ///< where a force without a name was learned
  std::string worstChannel;  ///< with the largest share of the excess error
  /// By channel: root mean square error of what was found in recordings that the analysis was never given, starts
  /// fitted. Empty where it could not be simulated there.
  Values fresh;
  Values calibrated;                                ///< by path: what was found
  std::map<std::string, Told> calibratedTold = {};  ///< by path
  double seconds = 0;
};
/// `fresh`: as in ProvedCase.
ProvedCase judged(const ConcealedAnswer& answer, const GapReport& report, const Values& fresh);
std::string toJsonText(const ProvedCase& proved);
ProvedCase provedFromJson(const std::string& text, const std::string& place);

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

/// What one case says of each question; nothing where the question does not arise.
struct CaseMarks {
  std::optional<bool> falseAlarm, named, alone, bothNamed, location, heldOutNear, confidentlyWrong, unexplained;
  std::optional<bool> numbersChanged;   ///< though nothing was wrong
  std::optional<double> heldOut;        ///< error over the noise that was added
  std::vector<double> parameterErrors;  ///< relative, of correctly named effects above the bar
  std::vector<double> calibratedErrors;
  std::vector<bool> parametersCovered;  ///< the truth lies in the 95 % interval: of the same effects
  std::vector<bool> calibratedCovered;  ///< the same of calibrated numbers, where the verdict is right
  /// Of either, in the same order: the truth lies in the interval among rivals, or in that above where there is none.
  std::vector<bool> parametersAmongRivals, calibratedAmongRivals;
  std::vector<std::pair<std::string, std::string>> confused;  ///< true name, what was said
};
CaseMarks mark(const ProvedCase& proved);

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

/// The same content for people in a terminal, as a self-contained page, and for programs ("uchilsim-proof-2").
std::string proofText(const ProofScore& score);
std::string proofHtml(const ProofScore& score);
std::string proofJson(const ProofScore& score, const std::vector<ProvedCase>& cases);

}  // namespace btr
