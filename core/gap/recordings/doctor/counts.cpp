#include "core/gap/recordings/doctor/counts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/command_by_position.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/figures.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

/// A column's numbers as they stand in the file where they change, and their steps.
struct Written {
  std::vector<std::size_t> row;
  std::vector<double> value, step;  ///< step[i] = value[i + 1] − value[i]
  Extent extent;
  bool whole = true;

  Written(const std::vector<double>& column, double scale, double offset) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!std::isfinite(column[i])) continue;
      double number = (column[i] - offset) / scale;
      if (std::abs(number - std::round(number)) < 1e-6)
        number = std::round(number);
      else
        whole = false;
      extent.add(number);
      if (!value.empty() && number == value.back()) continue;
      row.push_back(i);
      value.push_back(number);
    }
    for (std::size_t i = 1; i < value.size(); ++i) step.push_back(value[i] - value[i - 1]);
  }
};

/// The largest of the steps around step `i` that are no leaps.
double motionAround(const std::vector<double>& steps, const std::vector<char>& leaps, std::size_t i) {
  constexpr std::size_t reach = 4;
  double largest = 0;
  for (std::size_t k = i > reach ? i - reach : 0; k < std::min(steps.size(), i + reach + 1); ++k)
    if (!leaps[k]) largest = std::max(largest, std::abs(steps[k]));
  return largest;
}

/// Of the two steps beside step `i` that are no leaps.
double meanBeside(const std::vector<double>& steps, const std::vector<char>& leaps, std::size_t i) {
  double sum = 0, count = 0;
  for (const std::size_t k : {i - 1, i + 1})
    if (k < steps.size() && !leaps[k]) sum += steps[k], ++count;
  return count > 0 ? sum / count : 0;
}

std::vector<char> leapsBeyond(const std::vector<double>& steps, double least) {
  std::vector<char> leaps;
  for (const double step : steps) leaps.push_back(std::abs(step) > least);
  return leaps;
}

/// The step that nine of ten do not exceed.
double usual(const std::vector<double>& steps, const std::vector<char>& leaps) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!leaps[i]) sizes.push_back(std::abs(steps[i]));
  if (sizes.empty()) return 0;
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(9 * sizes.size() / 10);
  std::nth_element(sizes.begin(), place, sizes.end());
  return *place;
}

/// The bit that is a sign, −1 for none: all leaps of its size vanish where it is read as one.
int signBitOf(const Written& written) {
  if (!written.whole || written.value.size() < 20 || written.extent.low < 0 || written.extent.high < 64) return -1;
  const int bit = static_cast<int>(std::floor(std::log2(written.extent.high)));
  if (bit > 32) return -1;
  const auto leaps = leapsBeyond(written.step, std::ldexp(1, bit - 1));
  if (std::ranges::find(leaps, 1) == leaps.end()) return -1;
  // A command that jumps between 0 and 512 has one such number.
  constexpr std::size_t severalNumbers = 4;
  std::set<double> negative;
  for (const double value : written.value)
    if (withSign(value, bit) != value) negative.insert(value);
  if (negative.size() < severalNumbers) return -1;
  std::vector<double> steps;
  for (std::size_t i = 1; i < written.value.size(); ++i)
    steps.push_back(withSign(written.value[i], bit) - withSign(written.value[i - 1], bit));
  const double everywhere = usual(steps, leaps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double passable = 4 * std::max(everywhere, motionAround(steps, leaps, i)) + 2;
    // It changes where the number passes zero.
    const double nearest =
        std::min(std::abs(withSign(written.value[i], bit)), std::abs(withSign(written.value[i + 1], bit)));
    if (leaps[i] && (std::abs(steps[i]) > passable || nearest > passable)) return -1;
  }
  return bit;
}

/// Periods that counters have, in the file's unit. `turn` is a turn of the joint, 0 for one that slides.
std::vector<double> periods(const Written& written, double turn) {
  std::vector<double> known;
  if (turn > 0) known = {turn, 360};
  if (!written.whole) return known;
  for (int bits = 8; bits <= 32; ++bits) known.push_back(std::ldexp(1, bits));
  for (const double counts : {1000, 2000, 3600, 4000, 8000, 10000, 20000, 36000, 40000}) known.push_back(counts);
  return known;
}

/// How far the motion is from continuous where leaps are taken for a period: the median over them [the file's unit];
/// nothing where one does not fit.
std::optional<double> breakOf(const Written& written, const std::vector<char>& leaps, double period, bool isCommand) {
  const double range = written.extent.high - written.extent.low, rounding = written.whole ? 2 : 1e-6 * period;
  if (range > period * (1 + 1e-6) || range < 0.6 * period) return std::nullopt;
  std::vector<double> breaks;
  std::size_t moves = 0;
  for (std::size_t i = 0; i < leaps.size(); ++i) {
    if (!leaps[i]) continue;
    const double left = written.step[i] - std::copysign(period, written.step[i]);
    const double around = motionAround(written.step, leaps, i);
    if (std::abs(left) > 3 * around + rounding || std::abs(left) > period / 4) return std::nullopt;
    moves += around > 0;
    breaks.push_back(std::abs(left - meanBeside(written.step, leaps, i)));
  }
  // A motion leads up to it; what only jumps is a command, or nothing.
  if (moves == 0 || (isCommand && 2 * moves < breaks.size())) return std::nullopt;
  return median(std::move(breaks));
}

/// The period of a counter that begins again; 0 for none, or where it is not clear which.
double periodOf(const Written& written, double turn, bool isCommand) {
  const double range = written.extent.high - written.extent.low;
  if (written.value.size() < 20 || range <= 0) return 0;
  const auto leaps = leapsBeyond(written.step, range / 2);
  const auto count = static_cast<std::size_t>(std::ranges::count(leaps, 1));
  if (count == 0 || 4 * count > written.step.size()) return 0;
  std::vector<std::pair<double, double>> fitting;  // break, period
  for (const double period : periods(written, turn))
    if (const auto broken = breakOf(written, leaps, period, isCommand)) fitting.emplace_back(*broken, period);
  if (fitting.empty()) return 0;
  std::ranges::sort(fitting);
  const auto [least, period] = fitting.front();
  for (const auto& [broken, other] : fitting)
    if (std::abs(other - period) > 2e-3 * period && broken < 2 * least + 1e-3 * period) return 0;
  return period;
}

/// Reads one channel's counts anew.
class Counter {
 public:
  Counter(Recording& trial, std::size_t column, const MappedColumn* mapped)
      : trial_(trial), column_(column), channel_(trial.channels[column]), mapped_(mapped) {
    if (!mapped) return;
    scale_ = mapped->scale;
    offset_ = mapped->offset;
  }

  /// The period that was followed [the channel's unit], 0 for none.
  double mend() {
    mendSign();
    const auto name = parseChannel(channel_);
    const bool isCommand = name->quantity == "command_rad" || name->quantity == "command_m";
    if (!isCommand && name->quantity != "position_rad" && name->quantity != "position_m") return 0;
    const Written written(trial_.columns[column_], scale_, offset_);
    const double turn = name->quantity.ends_with("_rad") ? 2 * std::numbers::pi / std::abs(scale_) : 0;
    const double period = mapped_ && mapped_->wrap ? *mapped_->wrap : periodOf(written, turn, isCommand);
    if (!(period > 0)) return 0;
    const auto before = trial_.columns[column_];
    const std::size_t notes = trial_.notes.size();
    const double followed = follow(written, period);
    if (followed == 0 || !isCommand || (mapped_ && mapped_->wrap) || suitsPosition(before, followed)) return followed;
    trial_.columns[column_] = before;
    trial_.notes.resize(notes);
    return 0;
  }

 private:
  /// A command that really jumps is one that its joint follows back; one that begins again is not.
  bool suitsPosition(const std::vector<double>& before, double period) const {
    const std::string ending = channel_.substr(channel_.rfind('_'));
    const int position = trial_.column(channel_.substr(0, channel_.rfind('.') + 1) + "position" + ending);
    if (position < 0) return true;
    const std::vector<double>& measured = trial_.columns[static_cast<std::size_t>(position)];
    double jumps = 0, goesOn = 0;
    std::vector<double> apart;
    for (std::size_t row = 0; row < measured.size(); ++row)
      if (const double away = measured[row] - trial_.columns[column_][row]; std::isfinite(away)) apart.push_back(away);
    const double turns = std::round(median(std::move(apart)) / period) * period;
    for (std::size_t row = 0; row < measured.size(); ++row) {
      if (!std::isfinite(measured[row] - before[row])) continue;
      jumps += std::abs(measured[row] - before[row]);
      goesOn += std::abs(measured[row] - trial_.columns[column_][row] - turns);
    }
    return goesOn < jumps;
  }

  double& cell(std::size_t row) { return trial_.columns[column_][row]; }

  void mendSign() {
    if (mapped_ && !mapped_->added.empty()) return;
    const Written written(trial_.columns[column_], scale_, offset_);
    const int bit = mapped_ && mapped_->signBit ? *mapped_->signBit : signBitOf(written);
    if (bit < 0) return;
    std::size_t negative = 0;
    for (double& value : trial_.columns[column_]) {
      const double number = std::round((value - offset_) / scale_);
      if (!(number >= std::ldexp(1, bit))) continue;
      value = scale_ * withSign(number, bit) + offset_;
      ++negative;
    }
    if (negative > 0 && !(mapped_ && mapped_->signBit))
      trial_.notes.push_back(channel_ + ": bit " + std::to_string(bit) + " of its counts is the sign (values leap by " +
                             toText(std::ldexp(1, bit)) + " where they change it); " + std::to_string(negative) +
                             " values read as negative (\"sign_bit\": false in the mapping leaves them as they stand)");
  }

  double follow(const Written& written, double period) {
    double turns = 0;
    std::size_t times = 0;
    for (std::size_t i = 0; i < written.step.size(); ++i) {
      const double passed = std::round(written.step[i] / period);
      turns -= passed;
      times += passed != 0;
      const std::size_t last = i + 2 < written.row.size() ? written.row[i + 2] : trial_.rows();
      for (std::size_t row = written.row[i + 1]; turns != 0 && row < last; ++row) cell(row) += scale_ * turns * period;
    }
    if (times == 0) return 0;
    if (!(mapped_ && mapped_->wrap))
      trial_.notes.push_back(channel_ + ": its numbers begin again every " + digits(period, 6) + " (" +
                             std::to_string(times) + (times == 1 ? " time" : " times") +
                             "), and are followed on (\"wrap\": false in the mapping leaves them as they stand)");
    return period * std::abs(scale_);
  }

  Recording& trial_;
  std::size_t column_;
  std::string channel_;
  const MappedColumn* mapped_;
  double scale_ = 1, offset_ = 0;
};

/// Puts a followed position beside its command, or the command beside the position, by whole periods.
void putBeside(Recording& trial, const std::string& joint, const std::string& unit,
               const std::map<std::string, double>& followed) {
  const std::string position = joint + "position" + unit, command = joint + "command" + unit;
  const int a = trial.column(position), b = trial.column(command);
  if (a < 0 || b < 0) return;
  const auto &positions = trial.columns[static_cast<std::size_t>(a)],
             &commands = trial.columns[static_cast<std::size_t>(b)];
  std::vector<double> apart;
  double held = std::nan("");
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (std::isfinite(commands[i])) held = commands[i];
    if (std::isfinite(positions[i] - held)) apart.push_back(positions[i] - held);
  }
  const bool moves = followed.contains(position);
  const double period = followed.at(moves ? position : command);
  const double turns = std::round(median(std::move(apart)) / period);
  for (double& value : trial.columns[static_cast<std::size_t>(moves ? a : b)])
    value += (moves ? -turns : turns) * period;
}

}  // namespace

void mendCounts(Recording& trial, const Mapping* mapping) {
  std::map<std::string, double> followed;
  // A command is judged by its position.
  std::vector<std::size_t> order(trial.channels.size() - 1);
  std::iota(order.begin(), order.end(), std::size_t{1});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t column) { return !isInputChannel(trial.channels[column]); });
  for (const std::size_t column : order) {
    const std::string& channel = trial.channels[column];
    if (!parseChannel(channel)) continue;
    const double period = Counter(trial, column, mappedColumn(mapping, channel)).mend();
    if (period > 0) followed[channel] = period;
  }
  std::set<std::string> done;
  for (const auto& [channel, period] : followed) {
    const std::string joint = channel.substr(0, channel.rfind('.') + 1);
    if (done.insert(joint).second) putBeside(trial, joint, channel.ends_with("_rad") ? "_rad" : "_m", followed);
  }
  readCommandsByPosition(trial, mapping, followed);
}

}  // namespace btr
