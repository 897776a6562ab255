#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gap/search/gap_report.h"

namespace btr {

/// What the first screen of a report says, in report.html as in the window: what was found, what it takes of the error,
/// what to do next.
struct ReportLead {
  std::string headline;    ///< the finding in one line; a warning where there is one
  bool isWarning = false;  ///< nobody should adopt this as it is

  /// A named effect.
  struct Finding {
    std::size_t effect = 0;  ///< index into GapReport::tried
    std::string text;        ///< what it is, where, how large, and its rivals
  };
  std::vector<Finding> findings;
  std::string explained;              ///< how much of the error all of it takes, a sentence; "" where it is not known
  std::string rest;                   ///< the measured law of what has no name; "" where there is none
  std::vector<std::string> disagree;  ///< trials that do not fit together with the others, a sentence each

  /// Root mean square error of a channel.
  struct Error {
    std::string channel, unit;
    double before = 0, after = 0, noiseFloor = 0;  ///< as given, and with all that was found
  };
  std::vector<Error> errors;  ///< worst as given first, in noise floors
  std::size_t more = 0;       ///< channels that are not among `errors`
  bool heldOut = false;       ///< on recordings that no fit saw; else cross-validated
  std::string errorText;      ///< what the first of them says, a sentence

  /// Trial and series to look at: held out where there is one.
  std::optional<std::pair<std::size_t, std::size_t>> picture;
  std::vector<std::string> next;  ///< what to do, the first thing first
};

ReportLead leadOf(const GapReport& report);

/// Findings, errors and what to do as HTML without a style of its own, for a page and for Qt's rich text.
std::string leadHtml(const GapReport& report, const ReportLead& lead);
/// How much larger the error is without the effect, all others kept, as a sentence; "" where that is not known. What
/// its step took is no such measure: calibration, which comes first, bends its numbers to take up what has no name yet.
std::string withoutInWords(const GapReport::Effect& effect);

}  // namespace btr
