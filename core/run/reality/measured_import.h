#pragma once
#include <istream>
#include <string>
#include <vector>

#include "core/store/records.h"

namespace btr {

/// Reads a table of measured fitness (MEASURED.csv): a header line with the columns individual, value and, if wanted,
/// note and void, in any order; then one line for each measured value. void: 1, yes or true mark a value that does not
/// count (it may then be left empty), 0, no, false or nothing one that does. All of the table or nothing: the first
/// wrong cell throws InputError with file, line, column and what is allowed. With `tasks` given, individuals that none
/// of them names are wrong too. Cells may be separated by semicolons, where decimals have a comma. A heading "value
/// [cm]", "value (cm)" or "value_cm" is converted to `unit`, the fitness's own; a unit that cannot be converted is
/// refused. `places` takes "line 3" for each value. Run, who and time are left for the caller; the source is "person".
std::vector<MeasurementRecord> readMeasuredCsv(const std::string& path,
                                               const std::vector<MeasurementTask>* tasks = nullptr,
                                               const std::string& unit = "",
                                               std::vector<std::string>* places = nullptr);
std::vector<MeasurementRecord> readMeasuredCsv(std::istream& stream, const std::string& place,
                                               const std::vector<MeasurementTask>* tasks = nullptr,
                                               const std::string& unit = "",
                                               std::vector<std::string>* places = nullptr);

}  // namespace btr
