#include "core/plugin/measured_table.h"

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>

#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

constexpr std::array<const char*, 4> known{"individual", "value", "note", "void"};
constexpr const char* valueName = known[1];
constexpr std::size_t longestCell = 1u << 16;

std::string columnsAllowed(MeasuredTable::Of what) {
  return std::string("columns are ") + (what == MeasuredTable::Of::individuals ? "individual," : "") +
         "value[,note][,void], separated by commas, or by semicolons where decimals have a comma";
}

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
  const std::string value = valueName;
  if (!text.starts_with(value) || text == value) return {text, ""};
  const std::string rest = trimmed(text.substr(value.size()));
  if (rest.size() > 2 && ((rest.front() == '[' && rest.back() == ']') || (rest.front() == '(' && rest.back() == ')')))
    return {value, trimmed(rest.substr(1, rest.size() - 2))};
  if (rest.size() > 1 && rest.front() == '_') return {value, rest.substr(1)};
  return {text, ""};
}

long long readIndividual(const std::string& place, const std::string& cell) {
  long long id = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), id);
  if (error != std::errc() || end != cell.data() + cell.size() || id < 1)
    throw InputError(place, "the individual " + quoted(cell), "the number of an individual, 1 or more");
  return id;
}

bool readVoid(const std::string& place, const std::string& cell) {
  for (const char* yes : {"1", "yes", "true"})
    if (cell == yes) return true;
  for (const char* no : {"", "0", "no", "false"})
    if (cell == no) return false;
  throw InputError(place, quoted(cell), "1, yes, true (does not count) or 0, no, false or nothing");
}

/// Spreadsheets whose decimals have a comma write semicolons between the cells. The stream stays where it is.
bool hasDecimalCommas(std::istream& stream) {
  const std::istream::pos_type begin = stream.tellg();
  std::string header(longestCell, '\0');
  stream.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<std::size_t>(stream.gcount()));
  stream.clear();
  stream.seekg(begin);
  const std::size_t first = std::min(header.find_first_not_of(" \t\r\n"), header.size());
  header = header.substr(first, header.find_first_of("\r\n", first) - first);
  return header.find(',') == std::string::npos;
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

MeasuredTable::Conversion MeasuredTable::conversionOf(const std::string& place, const std::string& given,
                                                      const std::string& wanted) {
  if (given.empty() || given == wanted) return {};
  const HeadingUnit *from = unitOf(given), *to = unitOf(wanted);
  if (from && to && std::string(from->dimension) == to->dimension) return {from->times * to->by, from->by * to->times};
  std::string allowed;
  for (const HeadingUnit& u : units)
    if (to && std::string(u.dimension) == to->dimension) allowed += (allowed.empty() ? "" : ", ") + std::string(u.name);
  throw InputError(place, "values in the unit " + quoted(given),
                   allowed.empty() ? "a column " + quoted(valueName) + " without a unit" : allowed);
}

MeasuredTable::MeasuredTable(std::istream& stream, const std::string& place, const std::string& unit, Of what)
    : hasCommas_(hasDecimalCommas(stream)),
      csv_(stream, place, hasCommas_ ? ';' : ',', {.bytes = 64u << 20, .fieldBytes = longestCell, .fields = 100}) {
  if (!csv_.next(cells_)) throw InputError(place + ": is empty; " + columnsAllowed(what));
  width_ = cells_.size();
  readHeader(unit, what);
}

void MeasuredTable::readHeader(const std::string& unit, Of what) {
  const std::string allowed = columnsAllowed(what);
  for (std::size_t k = 0; k < width_; ++k) {
    const Heading heading = headingOf(trimmed(cells_[k]));
    const std::string& name = heading.name;
    if (name == valueName) conversion_ = conversionOf(csv_.at(k + 1), heading.unit, unit);
    const auto found =
        std::find(known.begin() + (what == Of::oneTrial ? valueColumn : individualColumn), known.end(), name);
    if (found == known.end()) throw InputError(csv_.at(k + 1), "the column " + quoted(name), allowed);
    int& place = places_[static_cast<std::size_t>(found - known.begin())];
    if (place >= 0) throw InputError(csv_.at(k + 1), "a second column " + quoted(name), allowed);
    place = static_cast<int>(k);
  }
  for (const Column needed : {individualColumn, valueColumn})
    if (places_[needed] < 0 && !(needed == individualColumn && what == Of::oneTrial))
      throw InputError(csv_.at(), "a table without the column " + quoted(known[needed]), allowed);
}

std::string MeasuredTable::cell(Column column) const {
  return places_[column] < 0 ? "" : trimmed(cells_[static_cast<std::size_t>(places_[column])]);
}

bool MeasuredTable::next(MeasuredRow& row) {
  // Spreadsheets end a table with lines of commas.
  const auto isEmpty = [](const std::string& text) { return trimmed(text).empty(); };
  do {
    if (!csv_.next(cells_)) return false;
  } while (std::all_of(cells_.begin(), cells_.end(), isEmpty));
  if (cells_.size() != width_)
    throw InputError(csv_.at(), "a row of " + std::to_string(cells_.size()) + " cells",
                     std::to_string(width_) + " as in the header");
  const std::string value = cell(valueColumn);
  row.note = cell(noteColumn);
  if (!hasCommas_ && places_[noteColumn] == places_[valueColumn] + 1 && mayBeDecimalComma(value, row.note))
    throw InputError(atValue(), quoted(value + "," + row.note),
                     "a value with a decimal point, and a note that is more than digits");
  row.individual = places_[individualColumn] < 0 ? 0 : readIndividual(atIndividual(), cell(individualColumn));
  row.isVoid = readVoid(at(voidColumn), cell(voidColumn));
  row.value = conversion_(readValue(atValue(), value, row.isVoid, hasCommas_));
  return true;
}

}  // namespace btr
