#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace btr {

/// A number as it was written.
struct WrittenNumber {
  double value = 0;
  double lastDigit = 0;  ///< what its last decimal is worth: 0.001 of "0.120", 10 of "1.2e2"; 0: no decimals
};

/// Reads a table's numbers. Decimals follow a point or a comma, the same one throughout: the first number that has
/// decimals decides.
class NumberReader {
 public:
  /// Nothing for what is not a finite number, for the other mark, and for separators of thousands.
  std::optional<WrittenNumber> read(std::string_view cell, long line);
  /// What is allowed, for a message about this cell.
  std::string allowed(std::string_view cell) const;

 private:
  char mark_ = 0;
  long decidedBy_ = 0;  ///< line
};

}  // namespace btr
