#pragma once
#include <string>

namespace btr {

// Numbers and names as people read them: in reports, sentences and the window.

/// "backlash" → "backlash", "velocity_reversal" → "velocity reversal".
std::string inWords(std::string name);
/// With a capital first letter, for the beginning of a sentence.
std::string capital(std::string text);
/// Three or four digits that matter; "–" if it is not finite.
std::string brief(double value);
/// "0.50 ± 0.14": a standard deviation from a few values has two digits that matter, and its mean as many decimals.
std::string withDeviation(double mean, double deviation);
/// So many digits that matter: "0.0512", "1230".
std::string digits(double value, int count = 3);
/// "0.7 %", "83 %".
std::string percent(double share);
/// "0.7 %", "83.3 %": for shares that stand below each other.
std::string tenthPercent(double share);
/// "+12 %", "-3 %": by how much something is off.
std::string signedPercent(double share);
/// "1 %", "83 %": for sentences.
std::string wholePercent(double share);

}  // namespace btr
