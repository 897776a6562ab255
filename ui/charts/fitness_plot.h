#pragma once
#include <QString>
#include <set>
#include <vector>

#include "core/store/records.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// What the fitness chart knows of one run.
struct FitnessRun {
  Id run = 0;
  QString name;
  QString experiment;    ///< names a group of runs in a comparison
  QString group;         ///< runs that differ in nothing but their seed share it; "" stands alone
  bool standIn = false;  ///< real fitness came from the stand-in reality
  std::vector<GenerationRecord> generations;
  std::vector<SimulatorRecord> simulators;
  std::vector<IndividualRecord> measuredIndividuals;  ///< those that `measurements` name
  std::vector<MeasurementRecord> measurements;
  /// Simulated fitness of individuals that wait to be measured blind: points of the curves that would tell it are left
  /// out.
  std::set<double> hidden;
};

/// "stand-in reality" or "".
QString realityNote(bool standIn);
/// The same of several runs: "some runs in stand-in reality" if not all of them are.
QString realityNote(const std::vector<FitnessRun>& runs);

/// One run: best and mean fitness by generation, worst (hidden at first), the best so far within each simulator
/// version, real fitness as mean ± standard error of an individual's repeats at its generation, and a line at each
/// simulator update.
PlotData fitnessPlot(const FitnessRun& run, const QString& unit);

/// Several runs over each other, one colour each. With `joinSeeds`, runs of the same group become one curve: the mean
/// over the runs of the best fitness, with its 95 % interval (Student's t) as far as at least two runs have come.
PlotData comparisonPlot(const std::vector<FitnessRun>& runs, const QString& unit, bool joinSeeds);

}  // namespace btr::ui
