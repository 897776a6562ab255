#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace btr {

/// As a separator: any number of blanks and tabulators; cells are never empty then.
inline constexpr char blanks = ' ';

/// Where a table's heading stands and what is between its columns.
struct TableLayout {
  long headingLine = 1;          ///< from 1; what stands above is a preamble
  std::size_t commentBytes = 0;  ///< of the heading's line, before its first column: "# "
  char separator = ',';
  std::size_t unnamed = 0;  ///< columns of a table without a heading, whose numbers begin in that line; 0: it has one
};

/// Finds the line that holds the name of the time column (and the most of the other wanted names), with commas,
/// semicolons, tabulators or bars between them, in the first 64 KiB of a file. `timeColumn` is "" where no column has
/// the time. Without such a line: the likeliest heading, else the first line from which on there is nothing but
/// numbers, else the first line that is no comment. Blanks separate where nothing else does and numbers follow.
TableLayout layoutOf(std::string_view beginning, const std::string& timeColumn,
                     const std::vector<std::string>& otherColumns);

/// Where a column stands in a heading: by its name, else by its number; nothing if it is not there.
std::optional<std::size_t> placeOf(const std::vector<std::string>& heading, const std::string& column);

/// A line's cells without the blanks around them; quotes around a cell hold separators and are taken off.
std::vector<std::string> splitCells(std::string_view line, char separator);

/// Cells that single blanks separated, as those that any number of them does.
void joinBlanks(std::vector<std::string>& cells);

/// Without blanks at either end.
std::string trimmed(std::string_view text);

/// A word that programs write where there is no number: "nan", "NA", "null", "None" in any case, "-", or what
/// spreadsheets say of an error ("#N/A", "#DIV/0!").
bool saysMissing(std::string_view cell);

/// A cell in a message: in quotes, short and printable whatever the file holds.
std::string shownCell(std::string_view text);

}  // namespace btr
