#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/gap/proof/proof_answer.h"
#include "core/gap/search/gap_report.h"

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

}  // namespace btr
