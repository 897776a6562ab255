#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/score.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/thresholds.h"

namespace btr {

struct SearchOptions {
  int jobs = 1;
  int maximumEffects = 3;
  std::vector<std::string> names;  ///< effects to consider; empty: all
  std::uint64_t seed = 1;
  AnalysisProgress progress;
  SearchThresholds thresholds{};
};

/// A candidate that was looked at, and what became of it.
struct Attempt {
  EffectCandidate candidate;
  int rank = 0;      ///< in the screening, 1 the best
  double share = 0;  ///< of the excess that the screening promised
  bool excited = true;
  bool fitted = false, scored = false, accepted = false;
  Values values;                                             ///< of the fit, or of the screening's best start
  PairedTest comparison;                                     ///< with the model before it
  double qValue = std::numeric_limits<double>::quiet_NaN();  ///< see GapReport::Effect
  std::string reason;
};

/// What became of a candidate, by its text.
void conclude(std::vector<Attempt>& attempts, const std::string& candidate, bool accepted, const std::string& reason);

/// An effect of the final simulator.
struct Found {
  PlacedEffect effect;
  PairedTest comparison;  ///< with the final simulator without it
  double qValue = 1;      ///< among all that its place was offered to
  std::vector<GapReport::Rival> rivals;
  std::vector<Fit> rivalFits;  ///< the whole simulator with each rival in its place
  std::vector<Uncertainty> rivalUncertainties;
};

struct SearchResult {
  Scored given, calibrated, final;
  std::vector<Found> effects;     ///< by effect of the final model
  std::vector<Attempt> attempts;  ///< of all stages; one per effect and place
  std::vector<GapReport::Step> ladder;
  Linearised calibratedLinear, finalLinear;
  Uncertainty calibratedUncertainty, finalUncertainty;
  double step_s = 0;                 ///< of the final fits [s]
  Eigen::VectorXd stepChange;        ///< of the final simulator's residuals with half that step
  std::vector<std::string> refused;  ///< what was left out, counted (refused_jobs.h)
  bool cutShort = false;             ///< whoever waits had enough: no more was looked for, nor rivals
  bool unstable = false;             ///< free runs predict blocks far worse than they fit them: windows are needed
};

/// Steps 4 and 6 to 8: calibrate, screen, confirm one effect at a time, drop what became useless, list rivals.
SearchResult searchEffects(const FitProblem& problem, const SearchOptions& options);

/// Of the integration: mean squared change with half the step [noise floors²].
double stepErrorOf(const Eigen::VectorXd& stepChange);

/// Mean over blocks of the excess over the noise: mean squared error − 1, not below 0.
double excessOf(const Scored& scored);

}  // namespace btr
