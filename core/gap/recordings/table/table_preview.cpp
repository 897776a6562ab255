#include "core/gap/recordings/table/table_preview.h"

#include <cmath>

#include "core/gap/recordings/table/number_reader.h"
#include "core/gap/recordings/table/table_reader.h"

namespace btr {

std::string numberedColumn(std::size_t number) { return "column " + std::to_string(number); }

TablePreview previewTable(const std::string& path, std::size_t rows) {
  TableReader table(path, "time_s", {});
  TablePreview preview;
  for (const std::string& name : table.header()) preview.columns.push_back({name, std::nan(""), std::nan("")});
  NumberReader numbers;
  std::vector<std::string> cells;
  for (std::size_t row = 0; row < rows && table.next(cells); ++row)
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (const auto number = numbers.read(cells[i], table.line())) {
        TablePreview::Column& column = preview.columns[i];
        column.low = std::fmin(column.low, number->value);  // a number rather than NaN
        column.high = std::fmax(column.high, number->value);
      }
  return preview;
}

}  // namespace btr
