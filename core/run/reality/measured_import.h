#pragma once
#include <istream>
#include <string>
#include <vector>

#include "core/store/records.h"

namespace btr {

/// Reads a table of measured fitness (MEASURED.csv), see MeasuredTable; all of it or nothing: what is wrong throws
/// InputError. With `tasks` given, individuals that none of them names are wrong too. `unit` is the fitness's own.
/// `places` takes "line 3" for each value. Run, who and time are left for the caller; the source is "person".
std::vector<MeasurementRecord> readMeasuredCsv(const std::string& path,
                                               const std::vector<MeasurementTask>* tasks = nullptr,
                                               const std::string& unit = "",
                                               std::vector<std::string>* places = nullptr);
std::vector<MeasurementRecord> readMeasuredCsv(std::istream& stream, const std::string& place,
                                               const std::vector<MeasurementTask>* tasks = nullptr,
                                               const std::string& unit = "",
                                               std::vector<std::string>* places = nullptr);

}  // namespace btr
