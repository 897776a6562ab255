#pragma once
#include <string>
#include <vector>

namespace btr {

/// A table of numbers under a header.
struct NumberTable {
  std::vector<std::string> header;
  std::vector<std::vector<double>> columns;
};
std::string toCsv(const NumberTable& table);
/// Empty cells are NaN. Throws InputError with line and column for anything else that is not a number.
NumberTable readNumberTable(const std::string& path);

}  // namespace btr
