#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gap/recordings/table/number_reader.h"
#include "core/gap/recordings/table/table_reader.h"
#include "core/gap/recordings/table/time_stamp.h"

namespace btr {

/// How a column of the file is used: which channel it fills, and how strictly its cells are read.
struct ColumnUse {
  std::string channel;
  std::size_t source = 0;
  double scale = 1, offset = 0;
  bool strict = true;                                 ///< a known channel: a cell that is not a number is an error
  std::size_t skipped = 0;                            ///< cells that are no numbers, of a channel that is not known
  std::vector<std::pair<std::size_t, double>> added;  ///< further columns of the file, and their scales
  double lastDigit = 0;                               ///< of the finest number read from `source`, 0: whole numbers
  std::size_t missing = 0;                            ///< cells that say so in a word
  double rowPeriod_s = 0;                             ///< of time that no column has: seconds from row to row
};

/// Reads the cells of one table: numbers as NumberReader has them, NaN for an empty cell and for a word
/// that says that there is none, time also as time stamps,
/// then in seconds after the first one. Throws InputError with line and column for what is neither, and for numbers
/// that no robot has. The table is borrowed.
class CellReader {
 public:
  explicit CellReader(const TableReader& table) : table_(table) {}

  double value(const std::vector<std::string>& cells, ColumnUse& use);
  /// How time was read, "" where it is plain seconds.
  std::string timeNote() const;

 private:
  double number(const std::string& cell, std::size_t source, ColumnUse& use);
  double seconds(const std::string& cell, std::size_t source, const ColumnUse& use);
  [[noreturn]] void refuse(std::size_t source, const ColumnUse& use, const std::string& cell,
                           const std::string& allowed) const;

  const TableReader& table_;
  NumberReader numbers_;
  std::optional<TimeStamp> first_;
  std::string firstText_;
  double days_s_ = 0, last_s_ = 0;
  bool numbered_ = false;  ///< time is a number
};

}  // namespace btr
