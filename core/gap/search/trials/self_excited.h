#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// A joint that swings by itself: at a frequency at which neither its command nor the simulator does so.
struct SelfExcitedSwing {
  std::string channel, trial;
  double from_s = 0, to_s = 0;  ///< the third of the trial in which it is strongest, in its own time
  double frequency_hz = 0;
  double amplitude = 0;  ///< there, √2 of the r.m.s. near that frequency [the channel's unit]
};

/// The strongest, in noise floors, of all commanded joints' positions. Spectra are of thirds of each trial (Hann's
/// window, straight line taken out); a swing counts if within ±25 % of its frequency, which must pass three times in
/// the third, the recording holds 25 times what the command and what the final simulator hold, more than half of the
/// error of the third, and more than three noise floors (r.m.s.).
/// `trials`: of the same problem, with recorded and final series.
std::optional<SelfExcitedSwing> selfExcitedSwing(const FitProblem& problem, const std::vector<GapReport::Trial>& trials,
                                                 const SearchThresholds::SelfExcitation& thresholds = {});

}  // namespace btr
