#include "core/gap/recordings/table/number_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace btr {
namespace {

double lastDigitOf(const char* begin, const char* end) {
  const char* exponent = std::find_if(begin, end, [](char c) { return c == 'e' || c == 'E'; });
  const char* point = std::find(begin, exponent, '.');
  if (point == exponent) return 0;
  int power = 0;
  if (exponent != end) std::from_chars(exponent + (exponent[1] == '+' ? 2 : 1), end, power);
  return std::pow(10, power - static_cast<double>(exponent - point - 1));
}

}  // namespace

std::optional<WrittenNumber> NumberReader::read(std::string_view cell, long line) {
  const auto first = cell.find_first_not_of(" \t");
  if (first == std::string_view::npos) return std::nullopt;
  cell = cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
  if (cell.starts_with('+') && cell.size() > 1 && cell[1] != '-' && cell[1] != '+') cell.remove_prefix(1);

  const std::size_t comma = cell.find(','), point = cell.find('.');
  const bool hasComma = comma != std::string_view::npos, hasPoint = point != std::string_view::npos;
  std::array<char, 64> copy{};
  if (hasComma) {
    if (hasPoint || mark_ == '.' || cell.size() > copy.size() || cell.find(',', comma + 1) != std::string_view::npos)
      return std::nullopt;
    std::copy(cell.begin(), cell.end(), copy.begin());
    copy[comma] = '.';
    cell = {copy.data(), cell.size()};
  } else if (hasPoint && mark_ == ',') {
    return std::nullopt;
  }
  WrittenNumber number;
  const char *begin = cell.data(), *end = begin + cell.size();
  const auto [stop, error] = std::from_chars(begin, end, number.value);
  if (error != std::errc() || stop != end || !std::isfinite(number.value)) return std::nullopt;
  if (mark_ == 0 && (hasComma || hasPoint)) {
    mark_ = hasComma ? ',' : '.';
    decidedBy_ = line;
  }
  number.lastDigit = lastDigitOf(begin, end);
  return number;
}

std::string NumberReader::allowed(std::string_view cell) const {
  std::string text = "a finite number or an empty cell";
  if (cell.find_first_of(",.") == std::string_view::npos) return text;
  if (mark_ != 0) {
    const bool other = cell.find(mark_ == '.' ? ',' : '.') != std::string_view::npos;
    if (other) {
      text += mark_ == '.' ? " (decimals after a point, as in line " : " (decimals after a comma, as in line ";
      text += std::to_string(decidedBy_);
      text += ", and nothing between thousands)";
    }
  } else if (cell.find(',') != std::string_view::npos) {
    text += " (decimals after a point or a comma, and nothing between thousands)";
  }
  return text;
}

}  // namespace btr
