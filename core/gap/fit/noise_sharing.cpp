#include "core/gap/fit/noise_sharing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/sample_speed.h"
#include "core/gap/recordings/squares.h"
#include "core/gap/recordings/stamp_truth.h"
#include "core/gap/replay/residual.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// A rate is compared only where the position is not recorded: it is the same motion seen through a filter.
bool isCompared(const Binding& binding, const Measured& measured) {
  if (measured.what != Measured::What::rate) return true;
  return std::none_of(binding.measured.begin(), binding.measured.end(), [&](const Measured& other) {
    return other.what == Measured::What::position && other.object == measured.object && other.part == measured.part;
  });
}

/// What one kind of sensor tells: "position_rad" of all joints, the three axes of a base or ball, its orientation.
std::string sensorOf(const std::string& channel) {
  const auto name = parseChannel(channel);
  if (!name) return channel;
  if (!name->part.empty() && !name->ofRoot()) return name->quantity;
  return name->quantity[0] == 'q' ? "orientation" : "place";
}

Extent extentOf(const std::vector<double>& values) {
  Extent extent;
  extent.add(values);
  return extent;
}

/// What is known of a channel in all trials.
struct Known {
  std::vector<double> levels;  ///< of the trials that show its noise
  std::vector<double> calm;    ///< those of them without fast motion in it
  double least = 1e-9;         ///< a millionth of what it moves
  double lastDigit = 0;
  bool few = false;                      ///< numbers in a trial
  bool jitters = false;                  ///< speed times jitter is part of a level
  std::vector<double> sensor, jitter_s;  ///< of the trials where it is: what is left of a level, and of the stamps
};

double rootMeanSquare(const std::vector<double>& values) {
  Squares squares;
  for (const double value : values) squares.add(value);
  return squares.rms();
}

/// What a motion makes of stamps that jitter differs from trial to trial; all of it together is the channel's.
double levelOf(const Known& known) {
  if (known.jitters) return rootMeanSquare(known.levels);
  return median(known.calm.empty() ? known.levels : known.calm);
}

/// A value in every other row at most: too far apart to show whether they follow stamps that jitter.
bool isSparse(const std::vector<double>& values) {
  const auto numbers = std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
  return 2 * static_cast<std::size_t>(numbers) <= values.size() + 1;
}

/// All samples of all trials together say that values are even, row by row, however coarse their counts: the slope
/// that right stamps would make 1 is clearly nearer to 0.
bool followNoStamps(const std::vector<FitTrial>& trials) {
  constexpr double nearer = 0.5, standardErrors = 5;
  double sum = 0, weight = 0;
  for (const FitTrial& trial : trials)
    for (const Measured& measured : trial.binding.measured) {
      if (!isCompared(trial.binding, measured)) continue;
      const StampTruth truth = stampTruth(trial.recording, measured.column);
      sum += truth.weight * truth.slope;
      weight += truth.weight;
    }
  if (!(weight > 0)) return false;
  const double slope = sum / weight;
  return std::abs(slope) < nearer && (1 - nearer) * std::sqrt(weight) > standardErrors;
}

/// Whether the logger's stamps jitter and its values do not. One trial that moves fast shows what another one hides;
/// where all are too sparse to tell, what the jitter may do counts as noise.
Stamps stampsOf(const std::vector<FitTrial>& trials) {
  constexpr double clearly = 0.2;
  bool some = false, sparse = true;
  double sum = 0, count = 0;
  for (const FitTrial& trial : trials)
    for (const Measured& measured : trial.binding.measured) {
      if (!isCompared(trial.binding, measured)) continue;
      const ChannelFloor floor = channelFloor(trial.recording, measured.column);
      if (!floor.shown || floor.byRows <= 0 || floor.byStamps <= 0) continue;
      some = some || followsRowsNotStamps(floor);
      sparse = sparse && isSparse(trial.recording.columns[measured.column]);
      sum += std::log(floor.byStamps / floor.byRows);
      ++count;
    }
  const bool areOff = some ? sum > 0 : sparse && sum > -clearly * count;
  return areOff || followNoStamps(trials) ? Stamps::off : Stamps::asShown;
}

/// Where stamps jitter, so do the commands that are replayed at them, and what follows a late one is late as a whole:
/// by row, the square of that lateness in jitters, Σ(change²)/(Σ|change|)² over the joint's commands of the last half
/// second, or the last one before it. One after a step; next to nothing along a smooth motion, whose commands are early
/// and late in turn.
std::vector<double> commandLateness(const FitTrial& trial, const Measured& measured) {
  constexpr double memory_s = 0.5;
  const std::vector<double>& time = trial.recording.columns[0];
  std::vector<double> lateness(time.size(), 0);
  if (measured.what != Measured::What::position && measured.what != Measured::What::rate) return lateness;
  const auto* command = trial.binding.input(Binding::Input::What::command, measured.object, measured.part);
  if (!command) return lateness;
  const std::vector<double>& commands = trial.recording.columns[command->column];
  std::vector<std::pair<double, double>> changes;  // when, and by how much
  std::size_t oldest = 0;
  double last = NAN;
  for (std::size_t row = 0; row < time.size(); ++row) {
    if (std::isfinite(commands[row])) {
      if (std::isfinite(last) && commands[row] != last) changes.emplace_back(time[row], std::abs(commands[row] - last));
      last = commands[row];
    }
    while (oldest + 1 < changes.size() && changes[oldest].first < time[row] - memory_s) ++oldest;
    double sum = 0, squares = 0;
    for (std::size_t i = oldest; i < changes.size(); ++i) {
      sum += changes[i].second;
      squares += changes[i].second * changes[i].second;
    }
    if (sum > 0) lateness[row] = squares / (sum * sum);
  }
  return lateness;
}

class NoiseFloors {
 public:
  explicit NoiseFloors(const std::vector<FitTrial>& trials) : stamps_(stampsOf(trials)) {
    for (const FitTrial& trial : trials)
      for (const Measured& measured : trial.binding.measured)
        if (isCompared(trial.binding, measured)) add(trial.recording, measured.column);
  }

  bool jitter() const {
    return std::ranges::any_of(known_, [](const auto& channel) { return channel.second.jitters; });
  }
  /// By row of a channel: √(sensor² + (speed·jitter)²), its own jitter and its commands'; empty where none was found.
  std::vector<double> bySample(const FitTrial& trial, const Measured& measured) const {
    const auto found = known_.find(trial.recording.channels[measured.column]);
    if (found == known_.end() || !found->second.jitters) return {};
    const double sensor = rootMeanSquare(found->second.sensor), jitter_s = rootMeanSquare(found->second.jitter_s);
    std::vector<double> floors = sampleSpeeds(trial.recording, measured.column, sensor);
    const std::vector<double> lateness = commandLateness(trial, measured);
    for (std::size_t row = 0; row < floors.size(); ++row)
      floors[row] = std::isfinite(floors[row])
                        ? std::hypot(sensor, floors[row] * jitter_s * std::sqrt(1 + lateness[row]))
                        : sensor;
    return floors;
  }
  /// 0 for a channel without a number.
  double of(const std::string& channel, std::vector<std::string>& notes) const {
    const auto found = known_.find(channel);
    if (found == known_.end()) return 0;
    const Known& own = found->second;
    if (!own.levels.empty()) return levelOf(own);
    const auto [level, from] = borrowed(channel, own);
    const double floor = std::max(level, own.least);
    const std::string text =
        channel +
        (own.few ? ": has too few numbers to show its noise" : ": stands still, so that it does not show its noise") +
        "; its noise floor, " + toText(floor) + " " + unitOfChannel(channel) + ", is " + from;
    if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
    return floor;
  }

 private:
  void add(const Recording& recording, std::size_t column) {
    const std::vector<double>& values = recording.columns[column];
    const Extent extent = extentOf(values);
    if (extent.empty()) return;
    Known& known = known_[recording.channels[column]];
    const double least = std::max(1e-6 * (extent.high - extent.low), 1e-9);
    known.least = std::max(known.least, least);
    const ChannelFloor floor = channelFloor(recording, column, stamps_);
    if (floor.shown) known.levels.push_back(std::max(floor.level, least));
    if (floor.shown && !floor.moves) known.calm.push_back(known.levels.back());
    if (floor.shown && floor.ofTime > 0) {
      known.jitters = true;
      known.sensor.push_back(std::max(floor.ofSensor, least));
      known.jitter_s.push_back(floor.jitter_s);
    }
    known.few = known.few || floor.few;
    if (column < recording.places.lastDigit.size())
      known.lastDigit = std::max(known.lastDigit, recording.places.lastDigit[column]);
  }

  /// The level of a channel that shows none, and where it is from, in words.
  std::pair<double, std::string> borrowed(const std::string& channel, const Known& own) const {
    constexpr double withoutAnything = 1e-6;
    const double ofRounding = 1 / std::sqrt(12.0);
    std::vector<double> others;
    double digit = own.lastDigit;
    std::string names;
    for (const auto& [name, known] : known_) {
      if (name == channel || sensorOf(name) != sensorOf(channel)) continue;
      if (own.lastDigit == 0) digit = std::max(digit, known.lastDigit);
      if (known.levels.empty()) continue;
      others.push_back(levelOf(known));
      names += (names.empty() ? "" : ", ") + name;
    }
    if (!others.empty()) return {median(others), "that of " + names};
    if (digit > 0) return {digit * ofRounding, "the rounding of the file's decimals"};
    return {withoutAnything, "a guess: nothing in these recordings determines it"};
  }

  Stamps stamps_;
  std::map<std::string, Known> known_;
};

}  // namespace

void shareNoiseFloors(std::vector<FitTrial>& trials, std::vector<std::string>& notes) {
  const NoiseFloors floors(trials);
  std::map<std::string, Squares> ofJittering;
  for (FitTrial& trial : trials) {
    trial.jitters = floors.jitter();
    trial.noiseFloor.clear();
    trial.sampleFloor.clear();
    for (const Measured& measured : trial.binding.measured) {
      const std::vector<double>& values = trial.recording.columns[measured.column];
      const std::string& channel = trial.recording.channels[measured.column];
      const bool counts = !extentOf(values).empty() && isCompared(trial.binding, measured);
      trial.noiseFloor.push_back(counts ? floors.of(channel, notes) : 0);
      trial.sampleFloor.push_back(counts ? floors.bySample(trial, measured) : std::vector<double>());
      for (std::size_t row = 0; row < trial.sampleFloor.back().size(); ++row)
        if (std::isfinite(values[row])) ofJittering[channel].add(trial.sampleFloor.back()[row]);
    }
  }
  // What is shown of a channel is the root mean square of its samples'.
  for (FitTrial& trial : trials)
    for (std::size_t c = 0; c < trial.noiseFloor.size(); ++c)
      if (trial.hasSampleFloors(c))
        trial.noiseFloor[c] = ofJittering[trial.recording.channels[trial.binding.measured[c].column]].rms();
}

}  // namespace btr
