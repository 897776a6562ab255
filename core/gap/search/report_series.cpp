// Recorded and simulated curves of a report, and its errors by channel.
#include "core/gap/search/report_series.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

#include "core/gap/fit/alignment.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/segments.h"
#include "core/gap/fit/starts_anew.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/recording.h"

namespace btr {
namespace {

std::string nameOf(const Recording& recording) { return std::filesystem::path(recording.source).filename().string(); }

struct Simulated {
  /// By trial and measured channel; NaN where nothing is simulated, or a fault ended the simulation.
  std::vector<std::vector<std::vector<double>>> values;
  std::vector<std::vector<std::size_t>> missed;  ///< by trial and channel: samples that a fault took away
};

Simulated simulateAll(const FitProblem& problem, const FitModel& model,
                      const std::vector<std::vector<double>>& shifts) {
  Simulated simulated;
  for (const FitTrial& trial : problem.trials) {
    simulated.values.emplace_back(trial.binding.measured.size(), std::vector<double>(trial.recording.rows(), NAN));
    simulated.missed.emplace_back(trial.binding.measured.size(), 0);
  }
  Eigen::VectorXd residuals = residualsOf(problem, model, shifts);
  align(problem, residuals);
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      const FitTrial& trial = problem.trials[segment.trial];
      const std::size_t c = segment.channel[k];
      if (residuals[at] == afterFault) {
        ++simulated.missed[segment.trial][c];
        continue;
      }
      simulated.values[segment.trial][c][segment.row[k]] =
          trial.recording.columns[trial.binding.measured[c].column][segment.row[k]] +
          residuals[at] * trial.floorAt(c, segment.row[k]);
    }
  return simulated;
}

/// The model with its numbers fixed, for other recordings: only how each of them began is fitted.
Fit carriedOver(const FitProblem& problem, const FitModel& model) {
  return withStartsAnew(problem, scoreAsIs(problem, {model, {}, 0}).fit);
}

/// Of one channel; NaN, for none, where a fault took one of its samples away.
struct Errors {
  double square = 0, absolute = 0, count = 0;
  bool faulted = false;
  /// `error` is NaN where nothing is simulated, and not counted.
  void add(double error) {
    if (!std::isfinite(error)) return;
    square += error * error;
    absolute += std::abs(error);
    ++count;
  }
  double rms() const { return faulted ? NAN : count > 0 ? std::sqrt(square / count) : 0; }
  double mean() const { return faulted ? NAN : count > 0 ? absolute / count : 0; }
};

GapReport::Channel& channelOf(GapReport& report, const std::string& name, double noiseFloor) {
  for (GapReport::Channel& channel : report.channels)
    if (channel.name == name) return channel;
  GapReport::Channel channel;
  channel.name = name;
  channel.unit = unitOfChannel(name);
  channel.noiseFloor = noiseFloor;
  report.channels.push_back(channel);
  return report.channels.back();
}

}  // namespace

void addErrors(GapReport& report, const FitProblem& problem, const Eigen::VectorXd& residuals,
               double GapReport::Channel::*rms, double GapReport::Channel::*mae) {
  std::map<std::string, std::pair<Errors, double>> byName;
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      const FitTrial& trial = problem.trials[segment.trial];
      const std::size_t c = segment.channel[k];
      auto& entry = byName[trial.recording.channels[trial.binding.measured[c].column]];
      entry.second = trial.noiseFloor[c];
      if (residuals[at] == afterFault)
        entry.first.faulted = true;
      else
        entry.first.add(residuals[at] * trial.floorAt(c, segment.row[k]));
    }
  for (const auto& [name, entry] : byName) {
    GapReport::Channel& channel = channelOf(report, name, entry.second);
    channel.*rms = entry.first.rms();
    channel.*mae = entry.first.mean();
  }
}

void addSeries(GapReport& report, const FitProblem& problem, const SearchResult& found, Whose whose) {
  const bool heldOut = whose == Whose::heldOut;
  const auto fits = [&](const Scored& scored) {
    return whose == Whose::fitted ? scored.fit : carriedOver(problem, scored.fit.model);
  };
  const Fit given = fits(found.given), calibrated = fits(found.calibrated), final = fits(found.final);
  const Simulated asGiven = simulateAll(problem, given.model, given.shifts),
                  asCalibrated = simulateAll(problem, calibrated.model, calibrated.shifts),
                  withEffects = simulateAll(problem, final.model, final.shifts);
  std::map<std::string, std::array<Errors, 3>> errors;
  std::map<std::string, Errors> floors;  // where each sample has its own
  for (std::size_t t = 0; t < problem.trials.size(); ++t) {
    const FitTrial& trial = problem.trials[t];
    GapReport::Trial out;
    out.name = nameOf(trial.recording);
    out.sha256 = trial.recording.sha256;
    out.heldOut = heldOut;
    out.setAside = whose == Whose::setAside;
    out.time_s = trial.recording.columns[0];
    for (std::size_t c = 0; c < trial.noiseFloor.size(); ++c) {
      if (trial.noiseFloor[c] <= 0) continue;
      const std::size_t column = trial.binding.measured[c].column;
      GapReport::Series series;
      series.channel = trial.recording.channels[column];
      series.unit = unitOfChannel(series.channel);
      series.noiseFloor = trial.noiseFloor[c];
      series.recorded = trial.recording.columns[column];
      series.asGiven = asGiven.values[t][c];
      series.calibrated = asCalibrated.values[t][c];
      series.withEffects = withEffects.values[t][c];
      auto& sums = errors[series.channel];
      sums[0].faulted |= asGiven.missed[t][c] > 0;
      sums[1].faulted |= asCalibrated.missed[t][c] > 0;
      sums[2].faulted |= withEffects.missed[t][c] > 0;
      for (std::size_t row = 0; row < series.recorded.size(); ++row) {
        sums[0].add(series.asGiven[row] - series.recorded[row]);
        sums[1].add(series.calibrated[row] - series.recorded[row]);
        sums[2].add(series.withEffects[row] - series.recorded[row]);
        if (trial.hasSampleFloors(c) && std::isfinite(series.recorded[row]))
          floors[series.channel].add(trial.floorAt(c, row));
      }
      if (heldOut) channelOf(report, series.channel, series.noiseFloor);
      out.series.push_back(std::move(series));
    }
    for (const auto& [which, simulated] :
         {std::pair{"as given", &asGiven}, {"calibrated", &asCalibrated}, {"in the end", &withEffects}}) {
      const auto& missed = simulated->missed[t];
      const std::size_t samples = std::accumulate(missed.begin(), missed.end(), std::size_t{0});
      if (samples > 0)
        report.notes.push_back(out.name + ": " + which + ", a fault ended the simulation: " + std::to_string(samples) +
                               " samples have no simulated value; their channels have no error, and where steps are "
                               "compared each of them counts as " +
                               toText(afterFault) + " noise floors");
    }
    report.trials.push_back(std::move(out));
  }
  if (!heldOut) return;
  for (const auto& [name, sums] : errors) {
    GapReport::Channel& channel = channelOf(report, name, 0);
    channel.heldoutAsGiven = sums[0].rms();
    channel.heldoutCalibrated = sums[1].rms();
    channel.heldoutWithEffects = sums[2].rms();
    channel.heldoutMaeAsGiven = sums[0].mean();
    channel.heldoutMaeCalibrated = sums[1].mean();
    channel.heldoutMaeWithEffects = sums[2].mean();
  }
  for (const auto& [name, floor] : floors) channelOf(report, name, 0).heldoutNoiseFloor = floor.rms();
}

}  // namespace btr
