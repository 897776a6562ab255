#include "core/gap/recordings/table/table_layout.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/gap/recordings/table/table_preview.h"
#include "core/gap/recordings/table/time_stamp.h"
#include "core/spec/error.h"

namespace btr {
namespace {

constexpr std::array separators{',', ';', '\t', '|'};
constexpr std::size_t mostLines = 1000;  // that are searched for a heading

/// LF, CRLF or CR; a last line without an end counts.
std::vector<std::string_view> linesOf(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<std::string_view> lines;
  while (!text.empty() && lines.size() < mostLines) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
    if (text.starts_with("\r\n"))
      text.remove_prefix(2);
    else if (!text.empty())
      text.remove_prefix(1);
  }
  return lines;
}

/// Bytes of a comment mark and the blanks around it, 0 for a line that is no comment.
std::size_t commentBytesOf(std::string_view line) {
  const std::size_t mark = line.find_first_not_of(" \t");
  if (mark == std::string_view::npos || (line[mark] != '#' && line[mark] != '%')) return 0;
  const std::size_t text = line.find_first_not_of("#% \t", mark);
  return text == std::string_view::npos ? 0 : text;
}

bool hasDigitsOnly(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789+-.,eE") == std::string::npos &&
         cell.find_first_of("0123456789") != std::string::npos;
}

/// Also a time stamp, or nothing.
bool beginsLikeNumber(const std::string& cell) {
  return cell.empty() || saysMissing(cell) || std::string_view("0123456789+-.").find(cell[0]) != std::string_view::npos;
}

bool hasNames(const std::vector<std::string>& cells) {
  return std::ranges::none_of(cells, [](const std::string& cell) { return cell.empty() || hasDigitsOnly(cell); });
}

/// Are there as many numbers in the next line, or behind up to two lines of units?
bool numbersFollow(const std::vector<std::string_view>& lines, std::size_t heading, std::size_t count, char separator) {
  constexpr std::size_t unitsAtMost = 2;
  for (std::size_t below = heading + 1; below < lines.size() && below <= heading + 1 + unitsAtMost; ++below) {
    const auto numbers = splitCells(lines[below], separator);
    if (numbers.size() == count && std::ranges::all_of(numbers, beginsLikeNumber)) return true;
  }
  return false;
}

/// Cells of a line of numbers, times and what says that there is none; 0: it is no such line.
std::size_t numbersIn(std::string_view line, char separator) {
  auto cells = splitCells(line, separator);
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  const auto isNumber = [](const std::string& cell) { return hasDigitsOnly(cell) || readTimeStamp(cell).has_value(); };
  const auto fits = [&](const std::string& cell) { return cell.empty() || saysMissing(cell) || isNumber(cell); };
  return std::ranges::all_of(cells, fits) && std::ranges::any_of(cells, isNumber) ? cells.size() : 0;
}

/// The first line of numbers that is followed by one of the same width, with the separator that makes most columns of
/// it. A line above it that names as many columns is its heading.
std::optional<TableLayout> numbersWithoutHeading(const std::vector<std::string_view>& lines) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!trimmed(lines[i]).empty() && commentBytesOf(lines[i]) == 0) rows.push_back(i);
  std::optional<TableLayout> best;
  for (const char separator : {',', ';', '\t', '|', blanks})
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const std::size_t width = numbersIn(lines[rows[k]], separator);
      if (width == 0 || numbersIn(lines[rows[k + 1]], separator) != width) continue;
      if (!best || width > best->unnamed) best = {static_cast<long>(rows[k]) + 1, 0, separator, width};
      break;
    }
  if (!best || best->headingLine == 1) return best;
  const auto above = static_cast<std::size_t>(best->headingLine) - 2;
  for (const std::size_t comment : {std::size_t{0}, commentBytesOf(lines[above])})
    if (const auto names = splitCells(lines[above].substr(comment), best->separator);
        names.size() == best->unnamed && hasNames(names))
      return TableLayout{static_cast<long>(above) + 1, comment, best->separator, 0};
  return best;
}

/// For a file without any of the wanted names: the first line of names above a line of as many numbers, so that a
/// message can say what the file has.
TableLayout likeliest(const std::vector<std::string_view>& lines) {
  for (const char separator : {',', ';', '\t', '|', blanks})
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto names = splitCells(lines[i], separator);
      if (names.size() < 2 || commentBytesOf(lines[i]) > 0 || !hasNames(names)) continue;
      if (numbersFollow(lines, i, names.size(), separator)) return {static_cast<long>(i) + 1, 0, separator};
    }
  if (const auto numbers = numbersWithoutHeading(lines)) return *numbers;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!trimmed(lines[i]).empty() && commentBytesOf(lines[i]) == 0) {
      TableLayout first{static_cast<long>(i) + 1, 0, ','};
      std::size_t most = 1;
      for (const char separator : separators)
        if (const std::size_t cells = splitCells(lines[i], separator).size(); cells > most) {
          first.separator = separator;
          most = cells;
        }
      return first;
    }
  return {};
}

}  // namespace

std::optional<std::size_t> placeOf(const std::vector<std::string>& heading, const std::string& column) {
  const auto named = std::ranges::find(heading, column);
  if (named != heading.end()) return static_cast<std::size_t>(named - heading.begin());
  for (std::size_t i = 0; i < heading.size(); ++i)
    if (column == numberedColumn(i + 1)) return i;
  return std::nullopt;
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

bool saysMissing(std::string_view cell) {
  std::string word = trimmed(cell);
  for (char& c : word) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
  constexpr std::array words{"nan",     "na",      "n/a",   "null",  "none",   "-",     "#n/a",
                             "#div/0!", "#value!", "#num!", "#ref!", "#null!", "#name?"};
  return std::ranges::find(words, word) != words.end();
}

std::string shownCell(std::string_view text) {
  std::string safe;
  for (const char byte : text.substr(0, 40)) {
    const auto code = static_cast<unsigned char>(byte);
    safe += code < 0x20 || code >= 0x7f ? '?' : byte;
  }
  return "\"" + safe + (text.size() > 40 ? "...\"" : "\"");
}

void joinBlanks(std::vector<std::string>& cells) {
  std::vector<std::string> words;
  for (const std::string& cell : cells) {
    std::istringstream text(cell);
    for (std::string word; text >> word;) words.push_back(word);
  }
  cells = std::move(words);
}

std::vector<std::string> splitCells(std::string_view line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char byte : line) {
    if (byte == '"')
      quoted = !quoted;
    else if (byte == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += byte;
  }
  if (separator == blanks) joinBlanks(cells);
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

TableLayout layoutOf(std::string_view beginning, const std::string& timeColumn,
                     const std::vector<std::string>& otherColumns) {
  const auto lines = linesOf(beginning);
  TableLayout best;
  std::size_t most = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::size_t comment : {std::size_t{0}, commentBytesOf(lines[i])})
      for (const char separator : separators) {
        const auto cells = splitCells(lines[i].substr(comment), separator);
        const auto has = [&](const std::string& name) { return std::ranges::find(cells, name) != cells.end(); };
        const bool counted = timeColumn.empty();
        if (!counted && !has(timeColumn)) continue;
        const std::size_t found =
            (counted ? 0 : 1) + static_cast<std::size_t>(std::ranges::count_if(otherColumns, has));
        if (found <= most) continue;
        most = found;
        best = {static_cast<long>(i) + 1, comment, separator};
      }
  if (most > 0) return best;

  // Sentences of a preamble have blanks, too: numbers follow a heading.
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::size_t comment : {std::size_t{0}, commentBytesOf(lines[i])}) {
      const auto cells = splitCells(lines[i].substr(comment), blanks);
      const auto has = [&](const std::string& name) { return std::ranges::find(cells, name) != cells.end(); };
      if ((timeColumn.empty() ? std::ranges::any_of(otherColumns, has) : has(timeColumn)) &&
          numbersFollow(lines, i, cells.size(), blanks))
        return {static_cast<long>(i) + 1, comment, blanks};
    }
  // Who counts columns knows of no names: a preamble of names above numbers is not taken for the table.
  const auto isCounted = [](const std::string& name) { return name.starts_with("column "); };
  if ((timeColumn.empty() || isCounted(timeColumn)) && !otherColumns.empty() &&
      std::ranges::all_of(otherColumns, isCounted))
    if (const auto numbers = numbersWithoutHeading(lines)) return *numbers;
  return likeliest(lines);
}

}  // namespace btr
