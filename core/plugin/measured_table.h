#pragma once
#include <array>
#include <istream>
#include <string>
#include <vector>

#include "core/spec/csv.h"

namespace btr {

/// One line of a table of measured fitness.
struct MeasuredRow {
  long long individual = 0;  ///< 0 where the table names none
  double value = 0;          ///< in the fitness's unit; 0 where a void trial has none
  bool isVoid = false;
  std::string note;
};

/// Reads measured fitness as people and spreadsheets write it: a header line with the columns value and, if wanted,
/// note and void, in any order, and individual where the table has values of several; then one line for each value.
/// void: 1, yes or true mark a value that does not count (it may then be left empty), 0, no, false or nothing one that
/// does. Cells may be separated by semicolons, where decimals have a comma; so has a table of one column. A heading
/// "value [cm]", "value (cm)" or "value_cm" is converted to the fitness's unit; a unit that cannot be converted is
/// refused. The first wrong cell throws InputError with place, line, column and what is allowed.
class MeasuredTable {
 public:
  enum class Of { individuals, oneTrial };

  /// Reads the header. The stream is borrowed.
  MeasuredTable(std::istream& stream, const std::string& place, const std::string& unit, Of what);
  /// The next row that holds anything; false at the end.
  bool next(MeasuredRow& row);
  /// "PLACE line 3, column 2": of the individual or the value in the row last read.
  std::string atIndividual() const { return at(individualColumn); }
  std::string atValue() const { return at(valueColumn); }
  long line() const { return csv_.line(); }

 private:
  enum Column { individualColumn, valueColumn, noteColumn, voidColumn, columns };
  /// What turns a value of the table into the fitness's unit.
  struct Conversion {
    double times = 1, by = 1;
    double operator()(double value) const { return times == by ? value : value * times / by; }
  };
  static Conversion conversionOf(const std::string& place, const std::string& given, const std::string& wanted);
  void readHeader(const std::string& unit, Of what);
  std::string cell(Column column) const;
  std::string at(Column column) const { return csv_.at(static_cast<std::size_t>(places_[column] + 1)); }

  bool hasCommas_;  ///< as decimals; semicolons separate
  CsvReader csv_;
  std::vector<std::string> cells_;
  std::size_t width_ = 0;
  std::array<int, columns> places_{-1, -1, -1, -1};  ///< for each column its place in the table, from 0, or −1
  Conversion conversion_;
};

}  // namespace btr
