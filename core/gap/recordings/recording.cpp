#include "core/gap/recordings/recording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/trials.h"
#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "core/spec/sha256.h"
#include "core/spec/utf8.h"

namespace btr {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Hands a file's bytes on and hashes them on the way: what was hashed is what was read.
class HashingBuffer : public std::streambuf {
 public:
  explicit HashingBuffer(const std::string& path) : file_(path, std::ios::binary), bytes_(1 << 16) {}
  bool isOpen() const { return file_.is_open(); }
  std::uintmax_t total() const { return total_; }
  bool endsWithLine() const { return last_ == '\n' || last_ == '\r'; }
  std::string finish() { return hash_.finish(); }

 protected:
  int_type underflow() override {
    file_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    const auto count = file_.gcount();
    if (file_.bad()) throw std::ios_base::failure("read error");  // the stream above sets its badbit
    if (count <= 0) return traits_type::eof();
    hash_.add({bytes_.data(), static_cast<std::size_t>(count)});
    total_ += static_cast<std::uintmax_t>(count);
    last_ = bytes_[static_cast<std::size_t>(count) - 1];
    setg(bytes_.data(), bytes_.data(), bytes_.data() + count);
    return traits_type::to_int_type(bytes_[0]);
  }

 private:
  std::ifstream file_;
  std::vector<char> bytes_;
  Sha256 hash_;
  std::uintmax_t total_ = 0;
  char last_ = 0;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A cell in a message: short and printable whatever the file holds.
std::string shown(const std::string& text) {
  std::string safe;
  for (const char byte : text.substr(0, 40)) {
    const auto code = static_cast<unsigned char>(byte);
    safe += code < 0x20 || code >= 0x7f ? '?' : byte;
  }
  return "\"" + safe + (text.size() > 40 ? "...\"" : "\"");
}

/// Control bytes and stray continuation bytes betray a binary or differently encoded file.
bool isText(const std::string& name) {
  const auto isControl = [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; };
  return std::ranges::none_of(name, isControl) && findInvalidUtf8(name) == std::string::npos;
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 20; ++i) text += (i ? ", " : "") + names[i];
  return names.size() > 20 ? text + ", ..." : text;
}

/// How a column of the file is used: which channel it fills, and how strictly its cells are read.
struct Use {
  std::string channel;
  std::size_t source = 0;
  double scale = 1, offset = 0;
  bool strict = true;  ///< a known channel: a cell that is not a number is an error
  std::size_t empty = 0, skipped = 0;
  std::vector<std::pair<std::size_t, double>> added;  ///< further columns of the file, and their scales
  double lastDigit = 0;                               ///< of the finest number read from `source`, 0: whole numbers
};

/// What a channel's numbers may be at most: far beyond robots in any unit that a mapping may have forgotten, far below
/// what a simulation could not compute with. Seconds since 1970 are a time.
double largestOf(const std::string& channel) {
  if (channel == "time_s") return 1e11;
  return parseChannel(channel) ? 1e7 : std::numeric_limits<double>::max();
}

/// What the last decimal of a number is worth: 0.001 of "0.120", 10 of "1.2e2"; 0 of a number without decimals.
double lastDigitOf(const char* begin, const char* end) {
  const char* exponent = std::find_if(begin, end, [](char c) { return c == 'e' || c == 'E'; });
  const char* point = std::find(begin, exponent, '.');
  if (point == exponent) return 0;
  int power = 0;
  if (exponent != end) std::from_chars(exponent + (exponent[1] == '+' ? 2 : 1), end, power);
  return std::pow(10, power - static_cast<double>(exponent - point - 1));
}

std::vector<std::string> readHeader(CsvReader& reader, const std::string& path) {
  std::vector<std::string> header;
  if (!reader.next(header))
    throw InputError(path + ": the file is empty; a header line and rows of numbers are expected");
  if (header.size() == 1) {
    for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabulators"}})
      if (header[0].find(separator) != std::string::npos)
        throw InputError(reader.at() + ": columns are separated by " + name +
                         "; commas between columns (and points in numbers) are expected");
  }
  std::set<std::string> taken;
  for (std::size_t i = 0; i < header.size(); ++i) {
    header[i] = trimmed(header[i]);
    if (!isText(header[i])) throw InputError(reader.at(i + 1), shown(header[i]), "a column name in UTF-8 text");
    if (header[i].empty()) throw InputError(reader.at(i + 1) + ": the column has no name");
    if (!taken.insert(header[i]).second)
      throw InputError(reader.at(i + 1), shown(header[i]) + " again", "each column name once");
  }
  return header;
}

/// time_s first, then the columns in the file's order.
std::vector<Use> usesOf(const std::vector<std::string>& header, const Mapping* mapping, Recording& recording) {
  std::vector<Use> uses;
  std::vector<char> mapped(header.size(), 0);
  std::set<std::string> taken;
  if (mapping) {
    for (const MappedColumn& column : mapping->columns) {
      const auto found = std::find(header.begin(), header.end(), column.column);
      if (found == header.end()) {
        if (!column.optional)
          throw InputError(recording.source + ": column \"" + column.column + "\" is missing, which " +
                           mapping->source + " maps to " + column.channel + "; the file has " + list(header));
        recording.notes.push_back("column \"" + column.column + "\" (" + column.channel + ") is not in this file");
        continue;
      }
      const auto source = static_cast<std::size_t>(found - header.begin());
      mapped[source] = 1;
      taken.insert(column.channel);
      uses.push_back({column.channel, source, column.scale, column.offset, true, 0, 0, {}});
      for (const MappedColumn::Added& term : column.added) {
        const auto other = std::find(header.begin(), header.end(), term.column);
        if (other == header.end() && !term.optional)
          throw InputError(recording.source + ": column \"" + term.column + "\" is missing, which " + mapping->source +
                           " adds to " + column.channel + "; the file has " + list(header));
        if (other == header.end()) continue;
        const auto place = static_cast<std::size_t>(other - header.begin());
        mapped[place] = 1;
        uses.back().added.emplace_back(place, term.scale);
      }
      if (!column.compare) recording.notCompared.push_back(column.channel);
    }
  }
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (mapped[i]) continue;
    if (taken.count(header[i]))
      throw InputError(recording.source + ": column \"" + header[i] + "\" has the name of a channel that " +
                       mapping->source + " fills from another column");
    const bool known =
        header[i] == "time_s" || parseChannel(header[i]) || (mapping && header[i] == mapping->segmentColumn);
    if (!known) recording.notes.push_back("column \"" + header[i] + "\" is not mapped to a channel; kept, not used");
    uses.push_back({header[i], i, 1, 0, known, 0, 0, {}});
  }
  std::stable_sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.source < b.source; });
  const auto time = std::find_if(uses.begin(), uses.end(), [](const Use& use) { return use.channel == "time_s"; });
  if (time == uses.end())
    throw InputError(recording.source + ": there is no column time_s; the file has " + list(header) +
                     "; a mapping (NAME.mapping.json beside it) says which column is what");
  std::rotate(uses.begin(), time, time + 1);
  return uses;
}

/// The number in a cell; what it is multiplied with and added to is the caller's.
double cellNumber(const std::string& cell, std::size_t source, Use& use, const CsvReader& reader) {
  const auto first = cell.find_first_not_of(" \t");
  if (first == std::string::npos) {
    ++use.empty;
    return nothing;
  }
  const char* begin = cell.data() + first;
  const char* end = cell.data() + cell.find_last_not_of(" \t") + 1;
  if (*begin == '+' && end - begin > 1 && begin[1] != '-' && begin[1] != '+') ++begin;
  double number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error == std::errc() && stop == end && std::isfinite(number)) {
    if (const double digit = source == use.source ? lastDigitOf(begin, end) : 0; digit > 0)
      use.lastDigit = use.lastDigit > 0 ? std::min(use.lastDigit, digit) : digit;
    return number;
  }
  if (use.strict) {
    std::string allowed = "a finite number or an empty cell";
    if (cell.find(',') != std::string::npos) allowed += " (decimals after a point)";
    throw InputError(reader.at(source + 1) + " (" + use.channel + ")", shown(cell), allowed);
  }
  ++use.skipped;
  return nothing;
}

double cellValue(const std::vector<std::string>& cells, Use& use, const CsvReader& reader) {
  double value = use.scale * cellNumber(cells[use.source], use.source, use, reader) + use.offset;
  for (const auto& [source, scale] : use.added) value += scale * cellNumber(cells[source], source, use, reader);
  if (const double largest = largestOf(use.channel); std::abs(value) > largest)
    throw InputError(reader.at(use.source + 1) + " (" + use.channel + ")", shown(cells[use.source]),
                     "at most " + toText(largest) + " in the channel's unit, either sign");
  return value;
}

void readRows(CsvReader& reader, const HashingBuffer& file, std::uintmax_t size, std::vector<Use>& uses,
              std::size_t width, Recording& recording) {
  constexpr std::size_t rowsForEstimate = 65536;
  std::vector<std::string> cells;
  while (reader.next(cells)) {
    if (cells.size() != width)
      throw InputError(reader.at(), std::to_string(cells.size()) + (cells.size() == 1 ? " column" : " columns"),
                       "as many as the header has, " + std::to_string(width));
    for (std::size_t i = 0; i < uses.size(); ++i) recording.columns[i].push_back(cellValue(cells, uses[i], reader));
    recording.places.line.push_back(static_cast<std::uint32_t>(reader.line()));

    const std::vector<double>& time = recording.columns[0];
    if (std::isnan(time.back()))
      throw InputError(reader.at(uses[0].source + 1) + " (time_s)", "an empty cell", "a time in every row");
    if (time.size() > 1 && !(time.back() > time[time.size() - 2]))
      throw InputError(reader.at(uses[0].source + 1) + " (time_s)",
                       toText(time.back()) + (time.back() == time[time.size() - 2] ? " again" : ""),
                       "times that increase from row to row; before it stands " + toText(time[time.size() - 2]));
    // Long files: ask for the memory at once, not twice the memory in doublings.
    if (time.size() == rowsForEstimate) {
      const double expected = 1.03 * static_cast<double>(size) / static_cast<double>(file.total()) * rowsForEstimate;
      for (std::vector<double>& column : recording.columns) column.reserve(static_cast<std::size_t>(expected));
      recording.places.line.reserve(static_cast<std::size_t>(expected));
    }
  }
}

}  // namespace

double Recording::samplePeriod() const {
  return (columns[0].back() - columns[0].front()) / static_cast<double>(rows() - 1);
}

int Recording::column(const std::string& name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

std::string Recording::at(std::size_t column, std::size_t row) const {
  const std::string place = places.file.empty() ? source : places.file;
  const std::string line = row < places.line.size() ? " line " + std::to_string(places.line[row]) : "";
  const std::string number = column < places.column.size() ? ", column " + std::to_string(places.column[column]) : "";
  return place + line + number + " (" + channels[column] + ")";
}

std::string Recording::atHeader(std::size_t column) const {
  if (column >= places.column.size()) return source;
  return places.file + " line " + std::to_string(places.headerLine) + ", column " +
         std::to_string(places.column[column]);
}

Recording readRecording(const std::string& path, const Mapping* mapping, std::size_t limit) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) throw InputError(path + ": there is no such file");
  if (!fs::is_regular_file(status)) throw InputError(path + ": is not a regular file");
  const std::uintmax_t size = fs::file_size(path, failure);
  if (!failure && size > limit)
    throw InputError(path, std::to_string(size) + " bytes", "at most " + std::to_string(limit) + " bytes");

  Recording recording;
  recording.source = path;
  if (mapping) recording.mapping = mapping->source;
  HashingBuffer buffer(path);
  if (!buffer.isOpen()) throw InputError(path + ": the file cannot be read");
  std::istream stream(&buffer);
  CsvReader reader(stream, path, ',', {.bytes = limit, .fieldBytes = 4096, .fields = 10'000});
  const std::vector<std::string> header = readHeader(reader, path);
  recording.places.file = path;
  recording.places.headerLine = static_cast<std::size_t>(reader.line());
  std::vector<Use> uses = usesOf(header, mapping, recording);
  for (const Use& use : uses) {
    recording.channels.push_back(use.channel);
    recording.places.column.push_back(use.source + 1);
  }
  recording.columns.resize(uses.size());
  readRows(reader, buffer, size, uses, header.size(), recording);
  if (recording.rows() == 0) throw InputError(path + ": there is a header but no row of numbers");
  recording.sha256 = buffer.finish();
  if (!buffer.endsWithLine())
    recording.notes.push_back("the last line, " + std::to_string(recording.places.line.back()) +
                              ", has no line end: it may have been cut off, even inside a number");

  for (const Use& use : uses) {
    recording.places.lastDigit.push_back(std::abs(use.scale) * use.lastDigit);
    const std::string of = " of " + std::to_string(recording.rows()) + " cells of \"" + use.channel + "\"";
    if (use.strict && use.empty > 0) recording.notes.push_back(std::to_string(use.empty) + of + " are empty");
    if (use.skipped > 0) recording.notes.push_back(std::to_string(use.skipped) + of + " are not numbers; left out");
  }
  if (mapping) {
    const std::string name = fs::path(path).filename().string();
    for (const TrialSetting& setting : mapping->settings) {
      if (name.find(setting.fileContains) == std::string::npos) continue;
      for (const auto& [place, value] : setting.values) recording.settings[place] = value;
    }
  }
  return recording;
}

}  // namespace btr
