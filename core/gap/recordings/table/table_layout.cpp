#include "core/gap/recordings/table/table_layout.h"

#include <algorithm>
#include <array>
#include <sstream>

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

/// For a file without any of the wanted names: the first line of names above a line of as many numbers, so that a
/// message can say what the file has.
TableLayout likeliest(const std::vector<std::string_view>& lines) {
  for (const char separator : {',', ';', '\t', '|', blanks})
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto names = splitCells(lines[i], separator);
      if (names.size() < 2 || commentBytesOf(lines[i]) > 0 || !hasNames(names)) continue;
      if (numbersFollow(lines, i, names.size(), separator)) return {static_cast<long>(i) + 1, 0, separator};
    }
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

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

bool saysMissing(std::string_view cell) {
  std::string word = trimmed(cell);
  for (char& c : word) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
  return word == "nan" || word == "na" || word == "n/a" || word == "null" || word == "none" || word == "-";
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
        if (!has(timeColumn)) continue;
        const std::size_t found = 1 + static_cast<std::size_t>(std::ranges::count_if(otherColumns, has));
        if (found <= most) continue;
        most = found;
        best = {static_cast<long>(i) + 1, comment, separator};
      }
  if (most > 0) return best;

  // Sentences of a preamble have blanks, too: numbers follow a heading.
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::size_t comment : {std::size_t{0}, commentBytesOf(lines[i])}) {
      const auto cells = splitCells(lines[i].substr(comment), blanks);
      if (std::ranges::find(cells, timeColumn) != cells.end() && numbersFollow(lines, i, cells.size(), blanks))
        return {static_cast<long>(i) + 1, comment, blanks};
    }
  return likeliest(lines);
}

}  // namespace btr
