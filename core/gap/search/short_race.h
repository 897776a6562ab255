#pragma once
#include <cstddef>

#include "core/gap/search/thresholds.h"

namespace btr {

/// Where a model leaves so much that nothing explains, costs are mostly of that: what costs twice as much is no other
/// end of its valley, and the race of candidates ends sooner. Behind SearchThresholds, whose numbers hold where less is
/// left; all of these bound the work [time] and were chosen by hand on a real servo (50 noise floors left).
struct ShortRace {
  double muchLeft = 25;       ///< error from which it is run (as verdict.muchLeft) [noise floors²]
  double hopeless = 2;        ///< instead of screening.hopeless, and of screening.inReach beside the final model
  double worthMore = 1.1;     ///< instead of confirmation.worthMore
  std::size_t screened = 16;  ///< candidates for an effect's place, after a first look at all
  std::size_t handedTo = 4;   ///< instead of rivals.handedTo
  int wayIterations = 8;      ///< instead of rivals.wayIterations
  double valley = 1.7;        ///< instead of rivals.valley
  double valleyEnd = 1.4;     ///< instead of rivals.valleyEnd
  int iterations = 10;        ///< of what arrives there; what is not within valleyEnd then is fitted no more
  double formRatio = 1.3;     ///< instead of rivals.formRatio

  bool isRun(double error) const { return error > muchLeft; }
  /// Screening that takes a first look at all, and few in full.
  SearchThresholds::Screening screening(const SearchThresholds& thresholds) const {
    SearchThresholds::Screening few = thresholds.screening;
    few.many = few.promising = screened;
    return few;
  }
};
inline constexpr ShortRace shortRace{};

}  // namespace btr
