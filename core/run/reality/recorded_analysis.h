#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/run/setup/prepared_experiment.h"

namespace btr {

/// A run's own gap analysis: what is analysed, besides its experiment. A value: any process that has it comes to the
/// same finding.
struct RecordedAnalysis {
  struct Table {
    std::string name, csv, mappingJson;  ///< of a stored recording
  };
  std::vector<Table> recordings;  ///< in the order in which they are analysed
  SimulatorSpec simulator;        ///< that is repaired
  RobotPose pose = RobotPose::hungUp;
  std::uint64_t seed = 0;
};

/// What a version is made of.
struct RecordedFinding {
  SimulatorSpec simulator;
  std::string evidence;  ///< what the analysis says, as the version keeps it: an object in JSON
};

/// The stored recording's trials, as an analysis reads them. Throws InputError.
std::vector<Recording> trialsOf(const RecordedAnalysis::Table& recording);

/// What `analysis` asks for, as a problem.
GapProblem problemOf(const PreparedExperiment& prepared, const RecordedAnalysis& analysis);

/// Analyses what problemOf() gave, with so many worker processes, on which the finding does not depend. Throws as
/// analyse() does.
RecordedFinding analyseRecorded(const PreparedExperiment& prepared, const PluginHost& host,
                                const RecordedAnalysis& analysis, const GapProblem& problem, int jobs,
                                const AnalysisProgress& progress);

}  // namespace btr
