// Walks: feet that land a little earlier decide where a run ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/search/gap_report.h"
#include "tests/prove/open_case.h"

namespace btr::prove {
namespace {

const PlacedEffect sag{"voltage_sag", "world", {{"per_torque_1_nm", 0.599564}}};
const CaseRequest request{77, 0, "ode", "walk", ""};

/// Of the rows [from, to) of a segment [noise floors, root mean square].
double errorIn(const FitProblem& problem, const Segment& segment, const std::vector<double>& residuals,
               std::size_t from, std::size_t to) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (segment.row[k] >= from && segment.row[k] < to) {
      sum += residuals[k] * residuals[k];
      ++count;
    }
  EXPECT_GT(count, 0) << problem.trials.size();
  return std::sqrt(sum / count);
}

// The dog's sagging voltage and true servos, over all that was recorded: what is compared the simulator that made the
// recording tells, begun as those first steps say; later it tells of another walk.
TEST(Walk, IsComparedOverItsFirstStepsWhichItsOwnSimulatorTells) {
  const Plugins plugins;
  const BlindCase blind = caseHiding({sag}, request, plugins);
  const GapProblem given = problemOf(blind, plugins);
  FitProblem problem = makeFitProblem(given, given.recordings, {plugins.library.make, plugins.library.names});
  const std::size_t compared = problem.trials[0].compared, all = given.recordings[0].rows();
  ASSERT_LT(compared, all);
  EXPECT_THAT(problem.notes, testing::Contains(testing::StartsWith("trial_1.csv: compared over its first 0.8 s")));
  for (const Segment& segment : problem.segments)
    for (const std::size_t row : segment.row) ASSERT_LT(row, problem.trials[segment.trial].rows());

  // Begun as its first steps say.
  problem.given = blind.simulator;
  FitOptions starts;
  starts.startsOnly = true;
  cutSegments(problem, 0);
  const Fit begun = fitModel(problem, givenModel(problem), {}, starts);
  for (FitTrial& trial : problem.trials) trial.compared = all;
  cutSegments(problem, 0);
  const Segment& whole = problem.segments[0];
  ASSERT_EQ(whole.nuisances.size(), begun.shifts[0].size());
  const std::vector<double> residuals =
      residualsOf(problem, whole, problem.sceneOf(blind.simulator, 0), begun.shifts[0]);
  const double within = errorIn(problem, whole, residuals, 0, compared);
  const double beyond = errorIn(problem, whole, residuals, compared, all);
  constexpr double told = 1.5;  // noise floors: what a report calls explained
  EXPECT_LT(within, told);
  EXPECT_GT(beyond, told);
}

// One of three trials alone. Compared over all of its four seconds the sag was one side minimum among many.
TEST(Walk, ShowsThatItsVoltageSags) {
  const Plugins plugins;
  GapProblem given = problemOf(caseHiding({sag}, request, plugins), plugins);
  given.recordings.resize(1);
  AnalysisOptions options;
  options.effects = {"voltage_sag", "gravity_tilt"};
  options.jobs = 2;
  options.maximumEffects = 1;
  const GapReport report = analyse(given, {plugins.library.make, plugins.library.names}, options);
  EXPECT_THAT(namedIn(report), testing::ElementsAre("voltage_sag")) << toPlainText(report);
}

}  // namespace
}  // namespace btr::prove
