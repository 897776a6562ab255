#include "core/gap/replay/number_table.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {

std::string toCsv(const NumberTable& table) {
  std::string csv;
  for (std::size_t i = 0; i < table.header.size(); ++i) csv += (i ? "," : "") + csvField(table.header[i]);
  csv += '\n';
  std::size_t rows = 0;
  for (const auto& column : table.columns) rows = std::max(rows, column.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (i) csv += ',';
      const auto& column = table.columns[i];
      if (row < column.size() && std::isfinite(column[row])) csv += toText(column[row]);
    }
    csv += '\n';
  }
  return csv;
}

NumberTable readNumberTable(const std::string& path) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) throw InputError(path + ": there is no such file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(path + ": cannot be read");
  CsvReader reader(stream, path, ',', {.bytes = std::size_t{1} << 30, .fieldBytes = 4096, .fields = 10'000});
  NumberTable table;
  if (!reader.next(table.header)) throw InputError(path + ": is empty; a header and rows of numbers are expected");
  table.columns.resize(table.header.size());
  std::vector<std::string> cells;
  while (reader.next(cells)) {
    if (cells.size() != table.header.size())
      throw InputError(reader.at(), std::to_string(cells.size()) + " columns",
                       "as many as the header has, " + std::to_string(table.header.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<double> number =
          cells[i].empty() ? std::numeric_limits<double>::quiet_NaN() : toNumber(cells[i]);
      if (!number) throw InputError(reader.at(i + 1), "this text", "a number or an empty cell");
      table.columns[i].push_back(*number);
    }
  }
  return table;
}

}  // namespace btr
