#include "core/run/reality/measured_import.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>

#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

constexpr std::array<const char*, 4> known{"individual", "value", "note", "void"};
enum Column { individualColumn, valueColumn, noteColumn, voidColumn };
constexpr std::size_t longestCell = 1u << 16;
constexpr const char* columnsAllowed =
    "columns are individual,value[,note][,void], separated by commas, or by semicolons where decimals have a comma";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string quoted(const std::string& text) { return '"' + (text.size() > 40 ? text.substr(0, 40) + "…" : text) + '"'; }

/// A unit that a heading may carry: the value in SI is value·times/by, so that 41 cm is 0.41 m exactly.
struct HeadingUnit {
  const char* name;
  const char* inColumn;  ///< as it ends a column's name
  const char* dimension;
  double times, by;
};
constexpr std::array<HeadingUnit, 9> units{{{"m", "m", "length", 1, 1},
                                            {"cm", "cm", "length", 1, 100},
                                            {"mm", "mm", "length", 1, 1000},
                                            {"m/s", "m_s", "speed", 1, 1},
                                            {"cm/s", "cm_s", "speed", 1, 100},
                                            {"mm/s", "mm_s", "speed", 1, 1000},
                                            {"rad/s", "rad_s", "turning", 1, 1},
                                            {"deg/s", "deg_s", "turning", std::numbers::pi, 180},
                                            {"°/s", "deg_s", "turning", std::numbers::pi, 180}}};

const HeadingUnit* unitOf(const std::string& text) {
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const auto& u) { return text == u.name || text == u.inColumn; });
  return found == units.end() ? nullptr : &*found;
}

/// What a heading says of its column: "value [cm]", "value (cm)" and "value_cm" are the column "value" in cm.
struct Heading {
  std::string name, unit;
};
Heading headingOf(const std::string& text) {
  const std::string value = known[valueColumn];
  if (!text.starts_with(value) || text == value) return {text, ""};
  const std::string rest = trimmed(text.substr(value.size()));
  if (rest.size() > 2 && ((rest.front() == '[' && rest.back() == ']') || (rest.front() == '(' && rest.back() == ')')))
    return {value, trimmed(rest.substr(1, rest.size() - 2))};
  if (rest.size() > 1 && rest.front() == '_') return {value, rest.substr(1)};
  return {text, ""};
}

/// What turns a value of the table into the fitness's unit.
struct Conversion {
  double times = 1, by = 1;
  double operator()(double value) const { return times == by ? value : value * times / by; }
};
Conversion conversionOf(const std::string& place, const std::string& given, const std::string& wanted) {
  if (given.empty() || given == wanted) return {};
  const HeadingUnit *from = unitOf(given), *to = unitOf(wanted);
  if (from && to && std::string(from->dimension) == to->dimension) return {from->times * to->by, from->by * to->times};
  std::string allowed;
  for (const HeadingUnit& u : units)
    if (to && std::string(u.dimension) == to->dimension) allowed += (allowed.empty() ? "" : ", ") + std::string(u.name);
  throw InputError(place, "values in the unit " + quoted(given),
                   allowed.empty() ? "a column " + quoted(known[valueColumn]) + " without a unit" : allowed);
}

// For each known column its place in the table, from 0, or −1.
std::array<int, 4> readHeader(const CsvReader& table, const std::vector<std::string>& names, const std::string& unit,
                              Conversion& conversion) {
  std::array<int, 4> places{-1, -1, -1, -1};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Heading heading = headingOf(trimmed(names[k]));
    const std::string& name = heading.name;
    if (name == known[valueColumn]) conversion = conversionOf(table.at(k + 1), heading.unit, unit);
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw InputError(table.at(k + 1), "the column " + quoted(name), columnsAllowed);
    int& place = places[static_cast<std::size_t>(found - known.begin())];
    if (place >= 0) throw InputError(table.at(k + 1), "a second column " + quoted(name), columnsAllowed);
    place = static_cast<int>(k);
  }
  for (const Column needed : {individualColumn, valueColumn})
    if (places[needed] < 0)
      throw InputError(table.at(), "a table without the column " + quoted(known[needed]), columnsAllowed);
  return places;
}

Id readIndividual(const std::string& place, const std::string& cell, const std::vector<MeasurementTask>* tasks) {
  Id id = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), id);
  if (error != std::errc() || end != cell.data() + cell.size() || id < 1)
    throw InputError(place, "the individual " + quoted(cell), "the number of an individual, 1 or more");
  if (tasks == nullptr || std::any_of(tasks->begin(), tasks->end(), [&](const auto& t) { return t.individual == id; }))
    return id;
  std::string asked;
  for (const MeasurementTask& task : *tasks) asked += (asked.empty() ? "" : ", ") + std::to_string(task.individual);
  throw InputError(place, "individual " + cell,
                   asked.empty() ? "this run asks for none" : "this run asks for " + asked);
}

bool readVoid(const std::string& place, const std::string& cell) {
  for (const char* yes : {"1", "yes", "true"})
    if (cell == yes) return true;
  for (const char* no : {"", "0", "no", "false"})
    if (cell == no) return false;
  throw InputError(place, quoted(cell), "1, yes, true (does not count) or 0, no, false or nothing");
}

/// What stands between the cells: spreadsheets whose decimals have a comma write semicolons. The stream stays where it
/// is.
char separatorIn(std::istream& stream) {
  const std::istream::pos_type begin = stream.tellg();
  std::string header(longestCell, '\0');
  stream.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<std::size_t>(stream.gcount()));
  stream.clear();
  stream.seekg(begin);
  const std::size_t first = std::min(header.find_first_not_of(" \t\r\n"), header.size());
  header = header.substr(first, header.find_first_of("\r\n", first) - first);
  return header.find(';') != std::string::npos && header.find(',') == std::string::npos ? ';' : ',';
}

/// A number with a decimal comma as one with a point; a text with several marks stays as it is, and is none.
std::string withPoint(std::string number) {
  const auto comma = number.find(',');
  if (comma != std::string::npos && number.find_first_of(".,", comma + 1) == std::string::npos &&
      number.find('.') == std::string::npos)
    number[comma] = '.';
  return number;
}

double readValue(const std::string& place, const std::string& cell, bool isVoid, bool hasCommas) {
  if (cell.empty() && isVoid) return 0;
  const std::optional<double> value = toNumber(hasCommas ? withPoint(cell) : cell);
  if (!value)
    throw InputError(place, cell.empty() ? "an empty value" : "the value " + quoted(cell),
                     hasCommas ? "a finite number" : "a finite number with a decimal point");
  return *value;
}

/// "101,0,53" in the columns individual, value, note: may be the individual 101 with 0,53.
bool mayBeDecimalComma(const std::string& value, const std::string& note) {
  const auto digitsOnly = [](const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  };
  const bool hasSign = !value.empty() && (value[0] == '-' || value[0] == '+');
  return digitsOnly(hasSign ? value.substr(1) : value) && digitsOnly(note);
}

}  // namespace

std::vector<MeasurementRecord> readMeasuredCsv(std::istream& stream, const std::string& place,
                                               const std::vector<MeasurementTask>* tasks, const std::string& unit,
                                               std::vector<std::string>* places) {
  const char separator = separatorIn(stream);
  const bool hasCommas = separator == ';';  // as decimals
  CsvReader table(stream, place, separator, {.bytes = 64u << 20, .fieldBytes = longestCell, .fields = 100});
  std::vector<std::string> cells;
  if (!table.next(cells)) throw InputError(place + ": is empty; " + columnsAllowed);
  const std::size_t width = cells.size();
  Conversion conversion;
  const std::array<int, 4> columns = readHeader(table, cells, unit, conversion);
  const auto cell = [&](Column column) {
    return columns[column] < 0 ? "" : trimmed(cells[static_cast<std::size_t>(columns[column])]);
  };
  const auto at = [&](Column column) { return table.at(static_cast<std::size_t>(columns[column] + 1)); };

  std::vector<MeasurementRecord> all;
  while (table.next(cells)) {
    // Spreadsheets end a table with lines of commas.
    if (std::all_of(cells.begin(), cells.end(), [](const std::string& text) { return trimmed(text).empty(); }))
      continue;
    if (cells.size() != width)
      throw InputError(table.at(), "a row of " + std::to_string(cells.size()) + " cells",
                       std::to_string(width) + " as in the header");
    if (!hasCommas && columns[noteColumn] == columns[valueColumn] + 1 &&
        mayBeDecimalComma(cell(valueColumn), cell(noteColumn)))
      throw InputError(at(valueColumn), quoted(cell(valueColumn) + "," + cell(noteColumn)),
                       "a value with a decimal point, and a note that is more than digits");
    MeasurementRecord& m = all.emplace_back();
    m.individual = readIndividual(at(individualColumn), cell(individualColumn), tasks);
    m.isVoid = readVoid(at(voidColumn), cell(voidColumn));
    m.value = conversion(readValue(at(valueColumn), cell(valueColumn), m.isVoid, hasCommas));
    if (places) places->push_back("line " + std::to_string(table.line()));
    m.note = cell(noteColumn);
  }
  if (all.empty()) throw InputError(place + ": holds no values below its header");
  return all;
}

std::vector<MeasurementRecord> readMeasuredCsv(const std::string& path, const std::vector<MeasurementTask>* tasks,
                                               const std::string& unit, std::vector<std::string>* places) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) throw InputError(path + ": is a folder; a CSV file is needed");
  // Opening a pipe that nobody writes to would wait for ever.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path + ": is not a regular file; a CSV file is needed");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path + ": cannot be read (" + std::strerror(errno) + ")");
  return readMeasuredCsv(stream, path, tasks, unit, places);
}

}  // namespace btr
