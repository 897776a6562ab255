#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/gap/proof/proved_case.h"
#include "core/gap/search/gap_report.h"

namespace btr {

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

/// `fresh`: as in ProvedCase.
ProvedCase judged(const ConcealedAnswer& answer, const GapReport& report, const Values& fresh);

}  // namespace btr
