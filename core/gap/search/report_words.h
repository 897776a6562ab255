#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"
#include "core/gap/search/thresholds.h"
#include "core/spec/figures.h"

namespace btr {

// What a report holds, in a few words.

/// "dry friction at rig.hinge"; at a place that all joints share (rig.*), "… at every joint of rig".
std::string inWords(const std::string& effect, const std::string& at);
/// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& words);
/// The accepted effects of a report, by what was found: the same effect at several places of one robot (or of nothing
/// else, at one place) stands together, in the order of the first.
std::vector<std::vector<const GapReport::Effect*>> findingsOf(const GapReport& report);
/// "dry friction at leg.hip, leg.knee and leg.ankle".
std::string inWords(const std::vector<const GapReport::Effect*>& finding);
/// The same, and what it is a rival together with.
std::string inWords(const GapReport::Rival& rival);
/// Whether rivals would put a number where its own interval does not hold it: more than twice as wide with them.
bool isWiderAmongRivals(const GapReport::Number& number);
/// "[0.047, 0.055]", with as many digits as tell its ends apart (3 to 6); an open side is "…".
std::string brief(const GapReport::Interval& interval);
/// "width_rad = 0.051 rad [0.047, 0.055]", without an interval where there is none; "width_rad not identifiable".
std::string inWords(const GapReport::Number& number);
/// Those of an effect, one after another; "" where it has none.
std::string numbersInWords(const GapReport::Effect& effect);
/// The same of one, and ", among rivals [0.02, 0.055]".
std::string inWordsWithRivals(const GapReport::Number& number);
/// What the verdict means, a few words.
std::string headline(GapReport::Verdict verdict);
/// Error of the recordings that no fit saw, root mean square over their channels in noise floors; nothing if none was
/// held out; NaN where a fault ended a simulation. It got worse where the simulator to adopt is off by 5 % more than
/// the one as given, or ends in a fault where that one did not.
struct UnseenError {
  double asGiven = 0, calibrated = 0, withEffects = 0;
  bool gotWorse() const;
};
/// The same of any two errors, NaN where a fault ended the simulation.
bool unseenGotWorse(double before, double after, double worse = SearchThresholds::Verdict{}.unseenWorse);
std::optional<UnseenError> unseenError(const GapReport& report);
/// "the recordings that were held out got worse: 259 → 278 noise floors"; "" if they did not.
std::string unseenWarning(const GapReport& report);
/// What the verdict means, and what speaks against it: a success on paper whose held-out recordings got worse is none.
std::string headline(const GapReport& report);

/// False where the simulator as given agrees with the recordings, or they cannot tell.
bool leavesSomethingToAdopt(GapReport::Verdict verdict);
const char* toText(EffectLaw::Acts acts);        ///< "drive", "contact", …; "not_said"
const char* toText(GapReport::Verdict verdict);  ///< "no_mismatch", "parameters_suffice", …

}  // namespace btr
