#include "core/gap/search/screening/locate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/thresholds.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// One joint (or ball coordinate) of one trial over time, as a regime sees it.
struct Motion {
  std::vector<double> time, position, rate, load;  ///< load: command − position, or the torque that was given
  std::string positionName, rateName, loadName;    ///< what these are; no name: there is none
  std::vector<char> enabled, saturated, onFloor;
  double fast = 0;  ///< its higher speeds
  double low = 0, high = 0;
};

/// Slope through the samples within `reach_s`, at least two on either side.
std::vector<double> smoothRate(const std::vector<double>& time, const std::vector<double>& x, double reach_s) {
  std::vector<double> rate(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::size_t from = i, to = i;
    while (from > 0 && (i - from < 2 || time[i] - time[from] < reach_s)) --from;
    while (to + 1 < x.size() && (to - i < 2 || time[to] - time[i] < reach_s)) ++to;
    if (time[to] > time[from] && std::isfinite(x[to]) && std::isfinite(x[from]))
      rate[i] = (x[to] - x[from]) / (time[to] - time[from]);
  }
  return rate;
}

/// Of a joint's position the contract's own name of its velocity; of anything else words.
std::string rateOf(const std::string& channel) {
  for (const auto& [position, velocity] :
       {std::pair{".position_rad", ".velocity_rad_s"}, std::pair{".position_m", ".velocity_m_s"}})
    if (channel.ends_with(position)) return channel.substr(0, channel.size() - std::string(position).size()) + velocity;
  return "rate of " + channel;
}

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

Motion motionOf(const FitProblem& problem, const Scene& scene, std::size_t trialIndex, const Measured& measured,
                const SearchThresholds::Location& limits) {
  const FitTrial& trial = problem.trials[trialIndex];
  Motion motion;
  motion.time = trial.recording.columns[0];
  motion.position = trial.recording.columns[measured.column];
  std::size_t column = measured.column;
  const std::size_t rows = motion.time.size();
  motion.load.assign(rows, 0);
  motion.enabled.assign(rows, 1);
  motion.saturated.assign(rows, 0);
  motion.onFloor.assign(rows, 0);
  const bool ofJoint = measured.what == Measured::What::position || measured.what == Measured::What::rate ||
                       measured.what == Measured::What::torque;
  if (ofJoint) {
    // A torque channel is seen against its joint's position where that is recorded.
    for (const Measured& other : trial.binding.measured)
      if (other.what == Measured::What::position && other.object == measured.object && other.part == measured.part)
        column = other.column;
    motion.position = trial.recording.columns[column];
    const Drive& drive = scene.robots[measured.object].drives[measured.part];
    for (const auto& input : trial.binding.inputs) {
      if (input.robot != measured.object || input.joint != measured.part) continue;
      const auto& given = trial.recording.columns[input.column];
      if (input.what == Binding::Input::What::command)
        motion.loadName = trial.recording.channels[input.column] +
                          (drive.kind == Drive::Kind::torque ? "" : " − " + trial.recording.channels[column]);
      for (std::size_t row = 0; row < rows; ++row) {
        if (!std::isfinite(given[row])) continue;
        if (input.what == Binding::Input::What::enabled) motion.enabled[row] = given[row] > 0.5;
        if (input.what != Binding::Input::What::command) continue;
        motion.load[row] = drive.kind == Drive::Kind::torque ? given[row] : given[row] - motion.position[row];
        if (drive.kind == Drive::Kind::servo)
          motion.saturated[row] = std::abs(drive.p * motion.load[row]) > limits.saturated * drive.maxTorque;
      }
    }
  } else if (measured.what == Measured::What::ballPosition) {
    for (const Measured& other : trial.binding.measured)
      if (other.what == Measured::What::ballPosition && other.object == measured.object && other.part == 2)
        for (std::size_t row = 0; row < rows; ++row)
          motion.onFloor[row] =
              trial.recording.columns[other.column][row] < limits.onFloor * scene.balls[measured.object].radius_m;
  }
  motion.positionName = trial.recording.channels[column];
  motion.rateName = rateOf(motion.positionName);
  motion.rate = smoothRate(motion.time, motion.position, limits.rate_s);
  std::vector<double> speeds;
  for (const double rate : motion.rate) speeds.push_back(std::abs(rate));
  motion.fast = quantile(speeds, limits.fast);
  motion.low = quantile(motion.position, limits.outer);
  motion.high = quantile(motion.position, 1 - limits.outer);
  return motion;
}

/// Rows shortly after the velocity changed its sign.
std::vector<char> afterReversal(const Motion& motion, const SearchThresholds::Location& limits) {
  std::vector<char> mask(motion.time.size(), 0);
  int direction = 0;
  double since = -1;
  for (std::size_t row = 0; row < mask.size(); ++row) {
    const double rate = motion.rate[row];
    if (std::abs(rate) > limits.moves * motion.fast) {
      const int now = rate > 0 ? 1 : -1;
      if (direction != 0 && now != direction) since = motion.time[row];
      direction = now;
    }
    mask[row] = since >= 0 && motion.time[row] - since <= limits.reversal_s;
  }
  return mask;
}

using Mask = std::function<std::vector<char>(const Motion&, const SearchThresholds::Location&)>;

Mask byRow(std::function<bool(const Motion&, std::size_t, const SearchThresholds::Location&)> test) {
  return [test = std::move(test)](const Motion& motion, const SearchThresholds::Location& limits) {
    std::vector<char> mask(motion.time.size());
    for (std::size_t row = 0; row < mask.size(); ++row) mask[row] = test(motion, row, limits);
    return mask;
  };
}

const std::vector<std::pair<std::string, Mask>>& regimes() {
  static const std::vector<std::pair<std::string, Mask>> all{
      {"velocity_reversal", afterReversal},
      {"low_speed", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return std::abs(m.rate[i]) < of.slowShare * m.fast;
       })},
      {"high_speed", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return std::abs(m.rate[i]) > of.fastShare * m.fast;
       })},
      {"positive_direction", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return m.rate[i] > of.slowShare * m.fast;
       })},
      {"negative_direction", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return m.rate[i] < -of.slowShare * m.fast;
       })},
      {"high_load",
       [](const Motion& m, const SearchThresholds::Location& of) {
         std::vector<double> loads;
         for (const double load : m.load) loads.push_back(std::abs(load));
         const double heavy = quantile(loads, of.heavy);
         std::vector<char> mask(m.time.size());
         for (std::size_t row = 0; row < mask.size(); ++row) mask[row] = heavy > 0 && std::abs(m.load[row]) > heavy;
         return mask;
       }},
      {"saturation",
       byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location&) { return m.saturated[i] != 0; })},
      {"switched_off",
       byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location&) { return m.enabled[i] == 0; })},
      {"on_the_floor",
       byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location&) { return m.onFloor[i] != 0; })},
      {"low_position", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return m.position[i] < m.low + of.endShare * (m.high - m.low);
       })},
      {"high_position", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return m.position[i] > m.high - of.endShare * (m.high - m.low);
       })},
      {"late_in_the_trial", byRow([](const Motion& m, std::size_t i, const SearchThresholds::Location& of) {
         return m.time[i] > m.time.front() + of.late * (m.time.back() - m.time.front());
       })}};
  return all;
}

/// Excess and motion of one channel, all trials.
struct ChannelExcess {
  std::vector<Motion> motions;  ///< by trial that has the channel
  std::vector<std::size_t> trials;
  std::vector<std::vector<double>> excess;  ///< by trial and row: squared residual − 1, or 0 where nothing is compared
  std::vector<std::vector<double>> signedError;
  double sum = 0;
};

/// Share of the excess inside a mask whose rows are turned by `shift` of the trial.
double shareInside(const ChannelExcess& channel, const std::vector<std::vector<char>>& masks, double shift) {
  double inside = 0, all = 0;
  for (std::size_t t = 0; t < channel.excess.size(); ++t) {
    const std::size_t rows = masks[t].size();
    const auto turn = static_cast<std::size_t>(shift * static_cast<double>(rows));
    for (std::size_t row = 0; row < rows; ++row) {
      all += channel.excess[t][row];
      if (masks[t][(row + turn) % rows]) inside += channel.excess[t][row];
    }
  }
  return all > 0 ? std::clamp(inside / all, 0.0, 1.0) : 0;
}

std::vector<GapReport::Regime> sharesOf(const ChannelExcess& channel, const SearchThresholds::Location& limits) {
  std::vector<GapReport::Regime> list;
  for (const auto& [name, mask] : regimes()) {
    std::vector<std::vector<char>> masks;
    double marked = 0, rows = 0;
    for (const Motion& motion : channel.motions) {
      masks.push_back(mask(motion, limits));
      marked += static_cast<double>(std::count(masks.back().begin(), masks.back().end(), 1));
      rows += static_cast<double>(masks.back().size());
    }
    if (marked == 0 || marked == rows) continue;
    GapReport::Regime regime{name, shareInside(channel, masks, 0), marked / rows, 1};
    // Against the same pattern of time turned by other amounts, which keeps its rhythm.
    const int turns = limits.turns;
    int asMuch = 0;
    for (int turn = 1; turn <= turns; ++turn)
      if (shareInside(channel, masks, turn / (turns + 1.0)) >= regime.shareOfExcess) ++asMuch;
    regime.pValue = (asMuch + 1.0) / (turns + 1.0);
    list.push_back(regime);
  }
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
    return a.shareOfExcess - a.shareOfTime > b.shareOfExcess - b.shareOfTime;
  });
  return list;
}

/// Share of the signed error's variance that the mean over bins of a variable explains.
double explainedBy(const ChannelExcess& channel, const std::function<double(const Motion&, std::size_t)>& variable,
                   const SearchThresholds::Location& limits) {
  const std::size_t bins = limits.bins;
  std::vector<double> x, e;
  for (std::size_t t = 0; t < channel.motions.size(); ++t)
    for (std::size_t row = 0; row < channel.signedError[t].size(); ++row) {
      if (channel.signedError[t][row] == 0) continue;
      x.push_back(variable(channel.motions[t], row));
      e.push_back(channel.signedError[t][row]);
    }
  if (x.size() < limits.samplesPerBin * bins) return 0;
  std::vector<double> edges;
  for (std::size_t b = 1; b < bins; ++b)
    edges.push_back(quantile(x, static_cast<double>(b) / static_cast<double>(bins)));
  std::vector<double> sum(bins, 0), count(bins, 0);
  double mean = 0, square = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto bin = static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x[i]) - edges.begin());
    sum[bin] += e[i];
    ++count[bin];
    mean += e[i] / n;
    square += e[i] * e[i];
  }
  double between = 0;
  for (std::size_t b = 0; b < bins; ++b)
    if (count[b] > 0) between += count[b] * std::pow(sum[b] / count[b] - mean, 2);
  const double total = square - n * mean * mean;
  return total > 0 ? between / total : 0;
}

std::vector<std::string> dependencesOf(const ChannelExcess& channel, const SearchThresholds::Location& limits) {
  std::vector<std::pair<double, std::string>> found;
  const auto add = [&](const std::string& what, const std::function<double(const Motion&, std::size_t)>& variable) {
    if (what.empty()) return;
    if (const double share = explainedBy(channel, variable, limits); share > limits.dependence)
      found.push_back({share, what});
  };
  const Motion& named = channel.motions.front();
  add(named.rateName, [](const Motion& m, std::size_t i) { return m.rate[i]; });
  add(named.positionName, [](const Motion& m, std::size_t i) { return m.position[i]; });
  add(named.loadName, [](const Motion& m, std::size_t i) { return m.load[i]; });
  add("time_s", [](const Motion& m, std::size_t i) { return m.time[i] - m.time.front(); });
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> names;
  for (const auto& [share, what] : found) names.push_back(what);
  return names;
}

/// The short stretches that hold most of the excess.
std::vector<GapReport::Window> windowsOf(const ChannelExcess& channel, const SearchThresholds::Location& limits) {
  std::vector<std::pair<double, GapReport::Window>> all;
  for (std::size_t t = 0; t < channel.excess.size(); ++t) {
    const auto& time = channel.motions[t].time;
    for (std::size_t first = 0; first < time.size();) {
      std::size_t last = first;
      double sum = 0;
      while (last < time.size() && time[last] < time[first] + limits.stretch_s) sum += channel.excess[t][last++];
      all.push_back({sum, {channel.trials[t], {time[first], time[last - 1]}}});
      first = last;
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<GapReport::Window> windows;
  for (const auto& [sum, window] : all)
    if (windows.size() < limits.stretches && sum > 0) windows.push_back(window);
  return windows;
}

}  // namespace

std::vector<GapReport::Located> locate(const FitModel& calibrated, const FitProblem& problem,
                                       const SearchThresholds::Location& thresholds) {
  const auto residualsIn = [&](const FitProblem& segments) {
    const Fit fit = fitModel(segments, calibrated, {}, {3, true});
    return residualsOf(segments, fit.model, fit.shifts);
  };
  // Short windows see an error where it is made, but for a robot that walks: no window can begin in a step.
  FitProblem used = problem;
  if (!problem.walks)
    cutSegments(used,
                std::max(thresholds.window_s, thresholds.windowSamples * problem.trials[0].recording.samplePeriod()));
  Eigen::VectorXd residuals = residualsIn(used);
  if (!problem.walks && residuals.squaredNorm() < thresholds.sensitive * static_cast<double>(residuals.size())) {
    used = problem;  // windows are too short to see it
    residuals = residualsIn(used);
  }

  const Scene scene = problem.sceneOf(calibrated.simulator(problem), 0);
  std::map<std::string, ChannelExcess> channels;
  Eigen::Index at = 0;
  for (const Segment& segment : used.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      const FitTrial& trial = used.trials[segment.trial];
      const Measured& measured = trial.binding.measured[segment.channel[k]];
      ChannelExcess& channel = channels[trial.recording.channels[measured.column]];
      if (channel.trials.empty() || channel.trials.back() != segment.trial) {
        const auto known = std::find(channel.trials.begin(), channel.trials.end(), segment.trial);
        if (known == channel.trials.end()) {
          channel.trials.push_back(segment.trial);
          channel.motions.push_back(motionOf(problem, scene, segment.trial, measured, thresholds));
          channel.excess.emplace_back(trial.recording.rows(), 0.0);
          channel.signedError.emplace_back(trial.recording.rows(), 0.0);
        }
      }
      const auto t = static_cast<std::size_t>(std::find(channel.trials.begin(), channel.trials.end(), segment.trial) -
                                              channel.trials.begin());
      channel.excess[t][segment.row[k]] = residuals[at] * residuals[at] - 1;
      channel.signedError[t][segment.row[k]] = residuals[at];
      channel.sum += residuals[at] * residuals[at] - 1;
    }

  double all = 0;
  for (const auto& [name, channel] : channels) all += std::max(0.0, channel.sum);
  std::vector<GapReport::Located> located;
  if (all < thresholds.leastExcess * static_cast<double>(residuals.size())) return located;
  for (const auto& [name, channel] : channels) {
    if (channel.sum < thresholds.leastOfChannels * all) continue;
    GapReport::Located place;
    place.channel = name;
    place.shareOfExcess = channel.sum / all;
    place.regimes = sharesOf(channel, thresholds);
    for (const GapReport::Regime& regime : place.regimes)
      if (place.when.empty() && regime.pValue < thresholds.leastP &&
          regime.shareOfExcess > thresholds.standsOut * regime.shareOfTime)
        place.when = regime.name;
    place.windows = windowsOf(channel, thresholds);
    place.dependsOn = dependencesOf(channel, thresholds);
    located.push_back(std::move(place));
  }
  std::stable_sort(located.begin(), located.end(),
                   [](const auto& a, const auto& b) { return a.shareOfExcess > b.shareOfExcess; });
  return located;
}

}  // namespace btr
