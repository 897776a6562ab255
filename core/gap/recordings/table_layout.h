#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace btr {

/// Where a table's heading stands and what is between its columns.
struct TableLayout {
  long headingLine = 1;          ///< from 1; what stands above is a preamble
  std::size_t commentBytes = 0;  ///< of the heading's line, before its first column: "# "
  char separator = ',';
};

/// Finds the line that holds the name of the time column (and the most of the other wanted names), with commas,
/// semicolons, tabulators or bars between them, in the first 64 KiB of a file. Without one: the first line that is no
/// comment. Throws InputError "PLACE line N: …" for columns that blanks separate.
TableLayout layoutOf(std::string_view beginning, const std::string& timeColumn,
                     const std::vector<std::string>& otherColumns, const std::string& place);

/// A line's cells without the blanks around them; quotes around a cell hold separators and are taken off.
std::vector<std::string> splitCells(std::string_view line, char separator);

/// Without blanks at either end.
std::string trimmed(std::string_view text);

/// A cell in a message: in quotes, short and printable whatever the file holds.
std::string shownCell(std::string_view text);

}  // namespace btr
