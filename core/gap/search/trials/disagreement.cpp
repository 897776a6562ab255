// Trials that one simulator does not fit together with the others.
#include "core/gap/search/trials/disagreement.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/segments.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/gap/search/trials/slip.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

std::vector<double> meanByTrial(const FitProblem& problem, const Eigen::VectorXd& residuals) {
  std::vector<double> squares(problem.trials.size(), 0), counts(problem.trials.size(), 0);
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      squares[segment.trial] += residuals[at] * residuals[at];
      ++counts[segment.trial];
    }
  for (std::size_t t = 0; t < squares.size(); ++t) squares[t] = counts[t] > 0 ? squares[t] / counts[t] : NAN;
  return squares;
}

double medianOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return NAN;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::vector<std::size_t> smallest(const std::vector<double>& errors, std::size_t count) {
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::less{}, [&](std::size_t i) { return errors[i]; });
  order.resize(count);
  std::ranges::sort(order);
  return order;
}

double sumOf(const std::vector<double>& errors, const std::vector<std::size_t>& which) {
  double sum = 0;
  for (const std::size_t i : which) sum += errors[i];
  return sum;
}

FitModel fitted(const FitProblem& problem, const FitModel& from, int iterations) {
  return fitModel(problem, from, {}, {iterations}).model;
}

/// Concentration steps: a fit to the trials that fit best, again and again; the errors of all by the last one.
std::vector<double> concentrated(const FitProblem& problem, FitModel model, std::vector<double> errors,
                                 std::size_t kept, const SearchThresholds::Trials& limits) {
  std::vector<std::size_t> best = smallest(errors, kept);
  double least = INFINITY;
  std::vector<double> result = errors;
  for (int step = 0; step < limits.trimmings; ++step) {
    model = fitted(only(problem, best), model, limits.iterations);
    errors = errorsByTrial(problem, model, limits.iterations);
    const double sum = sumOf(errors, smallest(errors, kept));
    if (sum < least) result = errors;
    const std::vector<std::size_t> next = smallest(errors, kept);
    if (next == best || sum >= least) break;
    least = sum;
    best = next;
  }
  return result;
}

struct Explanation {
  std::string what;
  double error = INFINITY;
};

/// How far a column goes, and how fast, but for a tenth of the time: a marker that slips jumps [its unit, and that per
/// second].
struct Reach {
  double range = 0, rate = 0;
};

Reach reachOf(const Recording& recording, std::size_t column) {
  constexpr std::size_t apart = 4;  // samples of a slope: noise counts less
  constexpr double usually = 0.9;
  const std::vector<double>&values = recording.columns[column], &time = recording.columns[0];
  double low = INFINITY, high = -INFINITY;
  std::vector<double> rates;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    low = std::min(low, values[row]);
    high = std::max(high, values[row]);
    if (row >= apart && std::isfinite(values[row - apart]))
      rates.push_back(std::abs(values[row] - values[row - apart]) / (time[row] - time[row - apart]));
  }
  Reach reach{high > low ? high - low : 0, 0};
  if (!rates.empty()) {
    const auto nth = rates.begin() + static_cast<std::ptrdiff_t>(usually * static_cast<double>(rates.size() - 1));
    std::nth_element(rates.begin(), nth, rates.end());
    reach.rate = *nth;
  }
  return reach;
}

/// Whether a trial moves, or is moved, farther or faster than all the others, so that it can show what they do not.
bool goesBeyond(const FitProblem& problem, std::size_t trial, const std::vector<std::size_t>& suspects, double beyond) {
  const Recording& own = problem.trials[trial].recording;
  for (std::size_t column = 1; column < own.columns.size(); ++column) {
    const Reach reach = reachOf(own, column);
    Reach most;
    bool known = false;
    for (std::size_t t = 0; t < problem.trials.size(); ++t) {
      const Recording& other = problem.trials[t].recording;
      const int same = other.column(own.channels[column]);
      if (t == trial || same < 0 || std::ranges::find(suspects, t) != suspects.end()) continue;
      const Reach each = reachOf(other, static_cast<std::size_t>(same));
      most = {std::max(most.range, each.range), std::max(most.rate, each.rate)};
      known = true;
    }
    if (known && (reach.range > beyond * most.range || reach.rate > beyond * most.rate)) return true;
  }
  return false;
}

/// A path's last part: "spin_x".
std::string shortName(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

/// One trial, and the simulator that the others made.
class OddTrial {
 public:
  OddTrial(const FitProblem& problem, std::size_t trial, const FitModel& others, const SearchThresholds::Trials& limits)
      : alone_(only(problem, {trial})), trial_(trial), others_(others), limits_(limits) {}

  std::optional<Explanation> byNumber() const;
  std::optional<Explanation> byOffset(const std::function<FitProblem(const std::vector<Recording>&)>& ready) const;
  std::optional<Explanation> byCommands(const std::function<FitProblem(const std::vector<Recording>&)>& ready) const;
  Explanation byAllNumbers() const;
  double error() const { return errorsByTrial(alone_, others_, limits_.iterations)[trial_]; }
  /// Root mean square of its motion about the mean [noise floors], over all channels.
  double motion() const;

 private:
  const Recording& recording() const { return alone_.trials[trial_].recording; }
  std::optional<Explanation> withNumber(const std::string& path, double low, double high) const;

  FitProblem alone_;
  std::size_t trial_;
  const FitModel& others_;
  const SearchThresholds::Trials& limits_;
};

double OddTrial::motion() const {
  const FitTrial& trial = alone_.trials[trial_];
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < trial.noiseFloor.size(); ++c) {
    if (trial.noiseFloor[c] <= 0) continue;
    double mean = 0, square = 0, n = 0;
    for (const double value : trial.recording.columns[trial.binding.measured[c].column])
      if (std::isfinite(value)) {
        mean += value;
        square += value * value;
        ++n;
      }
    if (n == 0) continue;
    sum += std::max(0.0, square / n - mean * mean / n / n) / (trial.noiseFloor[c] * trial.noiseFloor[c]);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

std::optional<Explanation> OddTrial::withNumber(const std::string& path, double low, double high) const {
  FitProblem problem = alone_;
  problem.given = others_.simulator(problem);
  const SimulatorSpec as = withSettings(problem.given, recording());
  const double now = numberByPath(problem.sceneOf(problem.given, trial_), path);
  problem.trials[trial_].recording.settings.erase(path);
  problem.given.values = as.values;
  const double size = std::max({std::abs(now), (high - low) / 20, 1e-6});
  FitModel model;
  model.parameters = {{path, "", -1, now, low, high, 0.1 * size, false}};
  double least = INFINITY, start = now;
  for (const double value :
       {now, -now, 0.0, 0.75 * low + 0.25 * high, (low + high) / 2, 0.25 * low + 0.75 * high, low, high}) {
    if (value < low || value > high) continue;
    model.values = {value};
    const double error = errorsByTrial(problem, model, 2)[trial_];
    if (error >= least) continue;
    least = error;
    start = value;
  }
  model.values = {start};
  const FitModel end = fitted(problem, model, 2 * limits_.iterations);
  const double error = errorsByTrial(problem, end, limits_.iterations)[trial_];
  return Explanation{"its " + shortName(path) + " would have to be " + digits(end.values[0]) + " instead of " +
                         digits(now) + " (" + path + ")",
                     error};
}

std::optional<Explanation> OddTrial::byNumber() const {
  std::optional<Explanation> best;
  const auto attempt = [&](const std::string& path, double low, double high) {
    try {
      const auto found = withNumber(path, low, high);
      if (found && (!best || found->error < best->error)) best = found;
    } catch (const InputError&) {
      // A number that this scene refuses on the way explains nothing.
    }
  };
  for (const auto& [path, value] : recording().settings) {
    // As far as this number goes in all trials, and beyond.
    double most = std::abs(value);
    for (const FitTrial& trial : alone_.trials)
      if (const auto other = trial.recording.settings.find(path); other != trial.recording.settings.end())
        most = std::max(most, std::abs(other->second));
    const bool isSigned = std::ranges::any_of(alone_.trials, [&, name = path](const FitTrial& trial) {
      const auto other = trial.recording.settings.find(name);
      return other != trial.recording.settings.end() && other->second < 0;
    });
    // What is never negative elsewhere may be a mass.
    const bool mayTurn =
        isSigned || path.find("spin") != std::string::npos || path.find("velocity") != std::string::npos;
    if (most > 0) attempt(path, mayTurn ? -limits_.range * most : 0, limits_.range * most);
  }
  for (const FitParameter& p : others_.parameters)
    if (p.effect < 0 && !recording().settings.contains(p.name)) attempt(p.name, p.minimum, p.maximum);
  return best;
}

std::optional<Explanation> OddTrial::byOffset(
    const std::function<FitProblem(const std::vector<Recording>&)>& ready) const {
  std::optional<Explanation> best;
  const FitTrial& trial = alone_.trials[trial_];
  for (std::size_t c = 0; c < trial.binding.measured.size(); ++c) {
    const Binding::Measured& measured = trial.binding.measured[c];
    if (trial.noiseFloor[c] <= 0 || !isPlace(measured.what)) continue;
    Recording moved = recording();
    double offset = 0;
    constexpr int settled = 3;  // the start moves with the offset
    for (int round = 0; round < settled; ++round) {
      const FitProblem problem = ready({moved});
      FitModel model = others_;
      const Fit starts = fitModel(problem, model, {}, {.iterations = limits_.iterations, .startsOnly = true});
      const Eigen::VectorXd residuals = residualsOf(problem, model, starts.shifts);
      std::vector<double> own;
      Eigen::Index at = 0;
      double square = 0;
      for (const Segment& segment : problem.segments)
        for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
          square += residuals[at] * residuals[at];
          if (segment.channel[k] == c) own.push_back(residuals[at] * problem.trials[0].floorAt(c, segment.row[k]));
        }
      const double error = square / static_cast<double>(std::max<Eigen::Index>(1, residuals.size()));
      const std::string& channel = recording().channels[measured.column];
      if (!best || error < best->error)
        best = Explanation{"its " + channel + " would have to be " + digits(std::abs(offset)) + " " +
                               unitOfChannel(channel) + (offset < 0 ? " less" : " more") + " than was recorded",
                           error};
      const double by = medianOf(own);
      if (!std::isfinite(by)) break;
      offset += by;
      for (double& value : moved.columns[measured.column]) value += by;
    }
  }
  return best;
}

/// All commands of a trial by one factor: it was driven by another setting than its file says.
std::optional<Explanation> OddTrial::byCommands(
    const std::function<FitProblem(const std::vector<Recording>&)>& ready) const {
  std::vector<std::size_t> columns;
  for (const Binding::Input& input : alone_.trials[trial_].binding.inputs)
    if (input.what == Binding::Input::What::command) columns.push_back(input.column);
  if (columns.empty()) return std::nullopt;
  const auto errorBy = [&](double factor) {
    Recording driven = recording();
    for (const std::size_t column : columns)
      for (double& value : driven.columns[column]) value *= factor;
    return errorsByTrial(ready({std::move(driven)}), others_, limits_.iterations)[0];
  };
  // Wide steps of the factor's logarithm, then ever closer ones: the motion of a quiet sensor is thousands of its noise
  // floors, so that a factor a thousandth off still leaves more than the others have.
  constexpr int farthest = 5;
  constexpr double widest = 0.2, closest = 1e-5;
  double best = 0, least = errorBy(1);
  for (int k = -farthest; k <= farthest; ++k)
    if (const double error = errorBy(std::exp(widest * k)); error < least) {
      least = error;
      best = widest * k;
    }
  for (double step = widest / 2; step > closest; step /= 2)
    for (const double way : {-step, step})
      if (const double error = errorBy(std::exp(best + way)); error < least) {
        least = error;
        best += way;
        break;
      }
  return Explanation{"its commands would have to be " + digits(std::exp(best)) + " times what was recorded", least};
}

Explanation OddTrial::byAllNumbers() const {
  const FitModel own = fitted(alone_, others_, 2 * limits_.iterations);
  std::string list;
  for (std::size_t i = 0; i < own.parameters.size(); ++i) {
    const FitParameter& p = own.parameters[i];
    if (std::abs(own.values[i] - others_.values[i]) < 0.5 * p.scale) continue;
    const std::string owner = p.effect < 0 ? "" : inWords(own.effects[static_cast<std::size_t>(p.effect)].effect) + " ";
    list += (list.empty() ? "" : ", ") + owner + shortName(p.name) + " " + digits(own.values[i]) + " instead of " +
            digits(others_.values[i]);
  }
  return {"by itself it would ask for other numbers than the others do" + (list.empty() ? "" : ": " + list),
          errorsByTrial(alone_, own, limits_.iterations)[trial_]};
}

/// The calibrated simulator with that effect of all that were fitted in vain that fits most trials best, and the errors
/// of all trials.
std::optional<std::pair<FitModel, std::vector<double>>> withAnotherEffect(
    const FitProblem& problem, const SearchResult& found,
    const std::function<double(const std::vector<double>&)>& trimmed) {
  std::optional<std::pair<FitModel, std::vector<double>>> best;
  for (const Attempt& attempt : found.attempts) {
    if (!attempt.fitted || attempt.accepted || attempt.values.empty()) continue;
    FitModel model = found.calibrated.fit.model.with(problem, attempt.candidate.placed(attempt.values));
    std::vector<double> errors = errorsByTrial(problem, model, 2);
    if (!best || trimmed(errors) < trimmed(best->second)) best.emplace(std::move(model), std::move(errors));
  }
  return best;
}

}  // namespace

std::vector<double> errorsByTrial(const FitProblem& problem, const FitModel& model, int iterations) {
  FitOptions options;
  options.iterations = iterations;
  options.startsOnly = true;
  const Fit fit = fitModel(problem, model, {}, options);
  return meanByTrial(problem, residualsOf(problem, fit.model, fit.shifts));
}

std::vector<std::size_t> outlying(const std::vector<double>& errors, const SearchThresholds::Trials& limits) {
  constexpr double normalMad = 1.4826;  // standard deviations in a median absolute deviation of a normal law
  constexpr double leastSpread = 0.15;  // of a logarithm: equal errors are no measure of one another
  std::vector<double> logarithms;
  for (const double error : errors) logarithms.push_back(std::log(std::max(error, 1e-6)) / 2);
  const double middle = medianOf(logarithms);
  std::vector<double> away;
  for (const double each : logarithms) away.push_back(std::abs(each - middle));
  const double spread = std::max(leastSpread, normalMad * medianOf(away));
  std::vector<std::size_t> list;
  for (std::size_t t = 0; t < errors.size(); ++t) {
    const double above = logarithms[t] - middle;
    if (above > std::log(limits.farOff) && above > limits.leastZ * spread && std::sqrt(errors[t]) > limits.leastFloors)
      list.push_back(t);
  }
  return list;
}

std::vector<std::size_t> outlyingTrials(const FitProblem& problem, const SearchResult& found, int jobs,
                                        const SearchThresholds::Trials& limits) {
  const std::size_t count = problem.trials.size();
  if (count < limits.least) return {};
  const std::vector<double> now =
      meanByTrial(problem, residualsOf(problem, found.final.fit.model, found.final.fit.shifts));
  const bool atNoise = std::ranges::all_of(now, [&](double error) { return std::sqrt(error) < limits.leastFloors; });
  if (atNoise) return {};
  const auto kept =
      std::max(count / 2 + 1, static_cast<std::size_t>(std::ceil(limits.keptShare * static_cast<double>(count))));

  // Starts: as all are fitted; as the trial alone whose numbers fit most of the others best; and with the one effect of
  // all that were tried that fits most trials best, as one trial that is wrong may have kept it out.
  const FitModel& model = found.final.fit.model;
  const auto alone = parallel(jobs, count, [&](std::size_t t) {
    FitProblem own = problem;
    own.jobs = 1;
    const FitModel fit = fitted(only(own, {t}), found.calibrated.fit.model, limits.iterations);
    std::vector<double> errors = errorsByTrial(own, fit, 2);
    errors.insert(errors.end(), fit.values.begin(), fit.values.end());
    return errors;
  });
  const auto trimmed = [&](const std::vector<double>& errors) { return sumOf(errors, smallest(errors, kept)); };
  std::optional<std::size_t> leader;
  double least = INFINITY;
  const auto errorsOf = [&](std::size_t t) {
    const auto begin = alone[t].numbers.begin();
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  for (std::size_t t = 0; t < count; ++t) {
    if (!alone[t].ok()) continue;
    const double sum = trimmed(errorsOf(t));
    if (sum >= least) continue;
    least = sum;
    leader = t;
  }
  std::vector<std::pair<FitModel, std::vector<double>>> starts{{model, now}};
  if (leader) {
    const std::vector<double>& numbers = alone[*leader].numbers;
    FitModel from = model;
    // The calibrated numbers come first.
    std::copy(numbers.begin() + static_cast<std::ptrdiff_t>(count), numbers.end(), from.values.begin());
    starts.emplace_back(std::move(from), errorsOf(*leader));
  }
  if (auto other = withAnotherEffect(problem, found, trimmed)) starts.push_back(std::move(*other));
  // Trimmed fits cost time: only where a start already shows a trial outside.
  std::vector<double> best;
  for (const auto& [from, errors] : starts) {
    const std::vector<double> then =
        outlying(errors, limits).empty() ? errors : concentrated(problem, from, errors, kept, limits);
    if (best.empty() || trimmed(then) < trimmed(best)) best = then;
  }
  std::vector<std::size_t> list = outlying(best, limits);
  if (list.size() > count - kept) list.clear();  // no majority that agrees
  return list;
}

GapReport::Disagreement explainDisagreement(const FitProblem& problem, std::size_t trial,
                                            const std::vector<std::size_t>& suspects, const FitModel& others,
                                            double errorOfOthers,
                                            const std::function<FitProblem(const std::vector<Recording>&)>& ready,
                                            const SearchThresholds::Trials& limits) {
  const OddTrial odd(problem, trial, others, limits);
  const Recording& recording = problem.trials[trial].recording;
  GapReport::Disagreement told;
  told.trial = std::filesystem::path(recording.source).filename().string();
  told.sha256 = recording.sha256;
  const double error = odd.error();
  const double enough = std::pow(limits.asOthers, 2) * std::max(1.0, errorOfOthers);
  told.error = std::sqrt(error);
  told.errorOfOthers = std::sqrt(errorOfOthers);

  auto best = odd.byNumber();
  if (const auto offset = odd.byOffset(ready); offset && (!best || offset->error < best->error)) best = offset;
  if (!best || best->error > enough)
    if (const auto driven = odd.byCommands(ready); driven && (!best || driven->error < best->error)) best = driven;
  if (!best || best->error > enough)
    if (const auto slip = findSlip(recording, others, limits.iterations, ready))
      if (!best || slip->error < best->error) best = Explanation{inWords(*slip), slip->error};
  const Explanation own = odd.byAllNumbers();
  told.errorAlone = std::sqrt(own.error);
  if (best && best->error <= enough) {
    told.what = best->what;
    told.errorAlone = std::sqrt(std::min(best->error, own.error));
  } else if (own.error <= enough) {
    told.what = own.what;
  } else if (!goesBeyond(problem, trial, suspects, limits.beyondOthers) ||
             (std::sqrt(error) > limits.unlike * odd.motion() && std::sqrt(own.error) > limits.unlike * odd.motion())) {
    told.what =
        "no numbers make the simulator move as it does, though it goes no farther and no faster than the others: "
        "it may be a recording of something else";
  } else {
    told.setAside = false;
    told.what =
        "no other number of its own explains it, and it goes farther or faster than the others: it may show more of "
        "what is missing than they do";
  }
  return told;
}

}  // namespace btr
