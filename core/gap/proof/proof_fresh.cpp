#include "core/gap/proof/proof_fresh.h"

#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/starts_anew.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/gap_report.h"

namespace btr {

Values freshErrors(const GapReport& report, const std::string& scene, const std::vector<std::string>& recordings,
                   const EffectLibrary& library) {
  AnalysisRequest request;
  request.scene = scene;
  request.recordings = recordings;
  GapProblem given = loadProblem(request);
  given.simulator = report.after;
  if (report.step_s > 0) given.scene.step_s = report.step_s;
  const FitProblem problem = makeFitProblem(given, given.recordings, library, report.window_s);
  // A model without parameters: the report's simulator as it is. A ball that bounces takes its time to find its start.
  FitOptions options;
  options.iterations = 40;
  options.startsOnly = true;
  const Fit fit = withStartsAnew(problem, fitModel(problem, {}, {}, options));
  const Eigen::VectorXd residuals = residualsOf(problem, fit.model, fit.shifts);

  std::map<std::string, std::pair<double, double>> sums;  // of squares, of samples
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k) {
      const std::size_t c = segment.channel[k];
      const FitTrial& trial = problem.trials[segment.trial];
      auto& [squares, samples] = sums[trial.recording.channels[trial.binding.measured[c].column]];
      squares += std::pow(residuals[at++] * trial.floorAt(c, segment.row[k]), 2);
      samples += 1;
    }
  Values errors;
  for (const auto& [channel, sum] : sums) errors[channel] = std::sqrt(sum.first / sum.second);
  return errors;
}

}  // namespace btr
