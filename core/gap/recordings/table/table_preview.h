#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace btr {

/// "column 3": what the third column is called where nothing names it, and where a mapping gives its number.
std::string numberedColumn(std::size_t number);

/// What a table's columns are called, and between which numbers they lie in its first rows.
struct TablePreview {
  struct Column {
    std::string name;
    double low = 0, high = 0;  ///< NaN: no number there
  };
  std::vector<Column> columns;
};

/// Of any table that a recording may be (see TableReader). Throws InputError.
TablePreview previewTable(const std::string& path, std::size_t rows = 5000);

}  // namespace btr
