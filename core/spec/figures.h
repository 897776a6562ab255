#pragma once
#include <string>

namespace btr {

// Numbers and names as people read them: in reports, sentences and the window.

/// "backlash" → "backlash", "velocity_reversal" → "velocity reversal".
std::string inWords(std::string name);
/// Three or four digits that matter; "–" if it is not finite.
std::string brief(double value);
/// So many digits that matter: "0.0512", "1230".
std::string digits(double value, int count = 3);
/// "0.7 %", "83 %".
std::string percent(double share);
/// "1 %", "83 %": for sentences.
std::string wholePercent(double share);

}  // namespace btr
