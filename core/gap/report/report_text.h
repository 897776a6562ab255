#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"

namespace btr {

/// What the folder of a report calls its files. The overlay of trial k carries its name, made fit for a file.
std::string overlayFileName(const GapReport& report, std::size_t trial);

/// "time_s,CHANNEL:recorded,…" of one trial; an empty cell where a value is unknown.
std::string overlayCsv(const GapReport::Trial& trial);
/// Fills time and values of a trial whose series are named already. Throws InputError.
void readOverlayCsv(const std::string& path, GapReport::Trial& trial);

/// The four curves of a series in the order of the overlay's columns, with the words behind the channel's name.
struct CurveName {
  const char* name;
  std::vector<double> GapReport::Series::*values;
};
inline constexpr std::array<CurveName, 4> curveNames{{{"recorded", &GapReport::Series::recorded},
                                                      {"as_given", &GapReport::Series::asGiven},
                                                      {"calibrated", &GapReport::Series::calibrated},
                                                      {"with_effects", &GapReport::Series::withEffects}}};

}  // namespace btr
