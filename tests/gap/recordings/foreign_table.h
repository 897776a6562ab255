#pragma once
// A table of numbers as other people's programs write it.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/spec/random.h"

namespace btr {

struct ForeignTable {
  std::vector<std::string> names;            ///< of its columns, the first is time
  std::vector<std::vector<double>> columns;  ///< NaN: an empty cell
  char separator = ',';
  char decimal = '.';
  std::string lineEnd = "\n";
  enum class Encoding { utf8, utf8Marked, utf16Little, utf16Big, utf16LittleUnmarked } encoding = Encoding::utf8;
  std::vector<std::string> preamble;
  std::vector<std::string> units;  ///< a row below the heading; empty: none
  bool quoteNames = false, quoteNumbers = false, separatorAtEnd = false, numbersRows = false, isoTime = false;
  std::string commentMark;                       ///< before the heading; "" for none
  std::size_t commentEvery = 0, emptyEvery = 0;  ///< rows between comments and rows without anything; 0: none

  std::string text() const {
    std::string all;
    for (const std::string& line : preamble) all += line + lineEnd;
    all += commentMark + row(names, quoteNames, "");
    if (!units.empty()) all += row(units, quoteNames, "");
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
      if (commentEvery > 0 && i % commentEvery == commentEvery - 1) all += "# \"so far, so good" + lineEnd;
      if (emptyEvery > 0 && i % emptyEvery == emptyEvery - 1)
        all += row(std::vector<std::string>(names.size()), false, "");
      std::vector<std::string> cells;
      for (const auto& column : columns) cells.push_back(cell(column[i]));
      if (isoTime) cells[0] = stamp(columns[0][i]);
      all += row(cells, quoteNumbers || (separator == ',' && decimal == ','), std::to_string(i));
    }
    return encoded(all);
  }

 private:
  /// Six decimals.
  std::string cell(double value) const {
    if (!std::isfinite(value)) return "";
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.6f", value);
    std::string text = buffer;
    if (decimal != '.') text[text.find('.')] = decimal;
    return text;
  }

  /// Seconds within one minute.
  std::string stamp(double second) const {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "2025-03-01T23:59:%09.6f", second);
    return buffer;
  }

  std::string row(const std::vector<std::string>& cells, bool quotes, const std::string& number) const {
    std::string line;
    if (numbersRows) line += number + separator;
    for (std::size_t i = 0; i < cells.size(); ++i)
      line += (i ? std::string(1, separator) : "") + (quotes ? "\"" + cells[i] + "\"" : cells[i]);
    return line + (separatorAtEnd ? std::string(1, separator) : "") + lineEnd;
  }

  /// Of text whose characters are at most two bytes long in UTF-8.
  std::string encoded(const std::string& utf8) const {
    if (encoding == Encoding::utf8) return utf8;
    if (encoding == Encoding::utf8Marked) return "\xEF\xBB\xBF" + utf8;
    const bool big = encoding == Encoding::utf16Big;
    std::string wide;
    const auto add = [&](int unit) {
      const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
      wide += {big ? high : low, big ? low : high};
    };
    if (encoding != Encoding::utf16LittleUnmarked) add(0xFEFF);
    for (std::size_t i = 0; i < utf8.size(); ++i) {
      const auto byte = static_cast<unsigned char>(utf8[i]);
      add(byte < 0x80 ? byte : (byte & 0x1F) << 6 | (static_cast<unsigned char>(utf8[++i]) & 0x3F));
    }
    return wide;
  }
};

/// Any way of writing the same numbers, drawn at random.
inline ForeignTable drawnTable(Random& random, const std::vector<std::vector<double>>& columns) {
  using Encoding = ForeignTable::Encoding;
  const auto oneOf = [&](auto list) { return list.begin()[random.below(list.size())]; };
  ForeignTable table;
  table.columns = columns;
  table.names = {oneOf(std::initializer_list<const char*>{"t", "Zeit [s]", "__time", "elapsed (s)", "%time"})};
  for (std::size_t i = 1; i < columns.size(); ++i)
    table.names.push_back(oneOf(std::initializer_list<const char*>{"/joint/", "Ist-", "q_", "Winkel \xC2\xB0 "}) +
                          std::to_string(i));
  table.separator = oneOf(std::initializer_list<char>{',', ';', '\t', '|'});
  table.decimal = random.chance(0.5) ? ',' : '.';
  table.lineEnd = oneOf(std::initializer_list<const char*>{"\n", "\r\n", "\r"});
  table.encoding =
      oneOf(std::initializer_list<Encoding>{Encoding::utf8, Encoding::utf8, Encoding::utf8Marked, Encoding::utf16Little,
                                            Encoding::utf16Big, Encoding::utf16LittleUnmarked});
  if (random.chance(0.4)) table.preamble = {"Messung 7; Pendel", "Datum:\t1.3.2025, 23:59", "", "\"halb"};
  if (random.chance(0.3)) table.preamble.insert(table.preamble.begin(), "# made by a logger, version 2");
  if (random.chance(0.4)) table.units = std::vector<std::string>(columns.size(), "[rad]");
  table.quoteNames = random.chance(0.5);
  table.quoteNumbers = random.chance(0.3);
  table.separatorAtEnd = random.chance(0.3);
  table.numbersRows = random.chance(0.2);
  table.isoTime = random.chance(0.3);
  if (!table.numbersRows && table.names[0][0] != '%' && random.chance(0.2)) table.commentMark = "# ";
  if (random.chance(0.3)) table.commentEvery = 5 + random.below(20);
  if (random.chance(0.3)) table.emptyEvery = 5 + random.below(20);
  return table;
}

}  // namespace btr
