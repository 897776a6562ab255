#include "core/gap/recordings/table/time_stamp.h"

#include <charconv>
#include <chrono>
#include <system_error>

namespace btr {
namespace {

/// Takes what it reads off the front of a text.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}
  bool done() const { return text_.empty(); }
  bool good() const { return good_; }

  /// A number of exactly so many digits, `low` to `high`.
  int number(std::size_t digits, int low, int high) {
    int value = 0;
    const auto part = text_.substr(0, digits);
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    good_ = good_ && part.size() == digits && part[0] != '-' && error == std::errc() &&
            stop == part.data() + part.size() && value >= low && value <= high;
    text_.remove_prefix(part.size());
    return value;
  }
  bool take(std::string_view marks) {
    if (text_.empty() || marks.find(text_[0]) == std::string_view::npos) return false;
    text_.remove_prefix(1);
    return true;
  }
  void need(std::string_view marks) { good_ = take(marks) && good_; }
  /// The digits that follow, as a part of one.
  double fraction() {
    double value = 0, parts = 1;
    good_ = good_ && !text_.empty() && text_[0] >= '0' && text_[0] <= '9';
    for (; !text_.empty() && text_[0] >= '0' && text_[0] <= '9'; text_.remove_prefix(1), parts *= 10)
      value = 10 * value + (text_[0] - '0');
    return value / parts;
  }
  char at(std::size_t place) const { return place < text_.size() ? text_[place] : '\0'; }

 private:
  std::string_view text_;
  bool good_ = true;
};

std::int64_t secondsOfDate(Scanner& scan) {
  const bool dayFirst = scan.at(2) == '.';
  int year = 0, month = 0, day = 0;
  if (dayFirst) {
    day = scan.number(2, 1, 31), scan.need("."), month = scan.number(2, 1, 12), scan.need(".");
    year = scan.number(4, 1900, 2200);
  } else {
    year = scan.number(4, 1900, 2200), scan.need("-"), month = scan.number(2, 1, 12), scan.need("-");
    day = scan.number(2, 1, 31);
  }
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) {
    scan.need("");  // the 30th of February
    return 0;
  }
  return std::int64_t{86400} * sys_days(date).time_since_epoch().count();
}

}  // namespace

std::optional<TimeStamp> readTimeStamp(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  Scanner scan(text);
  TimeStamp stamp;
  if (scan.at(2) != ':') {
    stamp.dated = true;
    stamp.second = secondsOfDate(scan);
    scan.need("T ");
  }
  stamp.second += 3600 * scan.number(2, 0, 23);
  scan.need(":");
  stamp.second += 60 * scan.number(2, 0, 59);
  scan.need(":");
  stamp.second += scan.number(2, 0, 60);
  if (scan.take(".,")) stamp.fraction = scan.fraction();
  if (scan.take("Zz")) {
    stamp.hasZone = true;
  } else if (scan.at(0) == '+' || scan.at(0) == '-') {
    stamp.hasZone = true;
    const int sign = scan.take("-") ? -1 : 1;
    if (sign > 0) scan.need("+");
    int zone = 3600 * scan.number(2, 0, 14);
    if (scan.take(":") || !scan.done()) zone += 60 * scan.number(2, 0, 59);
    stamp.second -= sign * zone;
  }
  if (!scan.good() || !scan.done()) return std::nullopt;
  return stamp;
}

}  // namespace btr
