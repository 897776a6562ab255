#include "core/gap/recordings/doctor/command_by_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/extent.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr double muchNearer = 0.3;

/// The last number of each row or above it; NaN before the first.
std::vector<double> heldOver(const std::vector<double>& values) {
  std::vector<double> held = values;
  for (std::size_t row = 1; row < held.size(); ++row)
    if (!std::isfinite(held[row])) held[row] = held[row - 1];
  return held;
}

/// Mean distance of two series where both are known.
double meanApart(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, count = 0;
  for (std::size_t row = 0; row < a.size(); ++row)
    if (const double apart = std::abs(a[row] - b[row]); std::isfinite(apart)) sum += apart, ++count;
  return count > 0 ? sum / count : 0;
}

class CommandReader {
 public:
  CommandReader(Recording& trial, std::size_t column, std::size_t position, const MappedColumn* mapped)
      : trial_(trial), column_(column), mapped_(mapped), position_(heldOver(trial.columns[position])) {
    scale_ = mapped ? mapped->scale : 1;
    offset_ = mapped ? mapped->offset : 0;
  }

  void readSign() {
    constexpr std::size_t severalNumbers = 4;
    if (mapped_ && (mapped_->signBit || !mapped_->added.empty())) return;
    Extent extent;
    std::vector<double> numbers;
    for (const double value : trial_.columns[column_]) {
      numbers.push_back((value - offset_) / scale_);
      if (std::abs(numbers.back() - std::round(numbers.back())) > 1e-6) return;
      extent.add(numbers.back());
    }
    if (extent.empty() || extent.low < -0.5 || extent.high < 64) return;
    const int bit = static_cast<int>(std::floor(std::log2(std::round(extent.high))));
    std::vector<double> read = trial_.columns[column_];
    std::set<double> negative;
    for (std::size_t row = 0; row < read.size(); ++row)
      if (const double number = std::round(numbers[row]); number >= std::ldexp(1, bit)) {
        read[row] = scale_ * withSign(number, bit) + offset_;
        negative.insert(number);
      }
    if (negative.size() >= severalNumbers)
      take(read, "bit " + std::to_string(bit) + " of its counts is the sign", "sign_bit");
  }

  /// `period` in the channel's unit.
  void readTurns(double period) {
    if (!(period > 0) || (mapped_ && mapped_->wrap)) return;
    Extent extent;
    extent.add(trial_.columns[column_]);
    const double range = extent.high - extent.low;
    if (extent.empty() || range > period * (1 + 1e-6) || range < 0.6 * period) return;
    std::vector<double> read = trial_.columns[column_];
    for (std::size_t row = 0; row < read.size(); ++row)
      if (const double turns = std::round((position_[row] - read[row]) / period); std::isfinite(turns))
        read[row] += turns * period;
    // A distance by chance is a quarter of a period in the mean.
    if (meanApart(heldOver(read), position_) < period / 8)
      take(read, "its numbers begin again every " + digits(period / std::abs(scale_), 6), "wrap");
  }

 private:
  void take(const std::vector<double>& read, const std::string& how, const std::string& key) {
    std::vector<double>& given = trial_.columns[column_];
    if (meanApart(heldOver(read), position_) > muchNearer * meanApart(heldOver(given), position_)) return;
    given = read;
    trial_.notes.push_back(trial_.channels[column_] + ": " + how + ", as its joint's position shows; read so (\"" +
                           key + "\": false in the mapping leaves the numbers as they stand)");
  }

  Recording& trial_;
  std::size_t column_;
  const MappedColumn* mapped_;
  std::vector<double> position_;
  double scale_ = 1, offset_ = 0;
};

}  // namespace

double withSign(double number, int bit) {
  const double half = std::ldexp(1, bit);
  return number >= half ? half - number : number;
}

const MappedColumn* mappedColumn(const Mapping* mapping, const std::string& channel) {
  if (!mapping) return nullptr;
  const auto found = std::ranges::find(mapping->columns, channel, &MappedColumn::channel);
  return found == mapping->columns.end() ? nullptr : &*found;
}

void readCommandsByPosition(Recording& trial, const Mapping* mapping, const std::map<std::string, double>& followed) {
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const std::string channel = trial.channels[column];
    const auto name = parseChannel(channel);
    if (!name || (name->quantity != "command_rad" && name->quantity != "command_m") || followed.contains(channel))
      continue;
    const bool turns = name->quantity == "command_rad";
    const std::string joint = channel.substr(0, channel.rfind('.') + 1);
    const std::string position = joint + (turns ? "position_rad" : "position_m");
    const int other = trial.column(position);
    if (other < 0) continue;
    CommandReader reader(trial, column, static_cast<std::size_t>(other), mappedColumn(mapping, channel));
    reader.readSign();
    const auto period = followed.find(position);
    if (period != followed.end()) reader.readTurns(period->second);
    if (turns) reader.readTurns(2 * std::numbers::pi);
  }
}

}  // namespace btr
