#pragma once
#include <vector>

#include "core/gap/fit/alignment.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"

namespace btr {

/// A fitted model and how well it predicts what it was not fitted to.
struct Scored {
  Fit fit;  ///< to everything
  std::vector<double>
      blocks;  ///< mean squared error of each block [noise floors²] by the fit to the other fold; −1: none
  Eigen::VectorXd heldOut;          ///< residuals of the same, all samples
  std::vector<double> sizes;        ///< by effect: its furthest parameter from neutral, in standard errors
  double step_s = 0;                ///< of the replays that were scored
  Alignment aligned{};              ///< of what is scored: `blocks` and `heldOut` are of residuals that were shifted so
  std::vector<double> unshifted{};  ///< `blocks` of residuals that were not; empty where nothing was fitted

  double mean() const;  ///< over the blocks
};

/// The parameters as either half of the blocks alone would have them (a linear step from the fit to everything); each
/// scores the other half. Initial states stay: they are part of what is scored.
Scored crossValidate(const FitProblem& problem, const Fit& fit);
/// The same, where its sensitivities are known: they are most of the work.
Scored crossValidate(const FitProblem& problem, const Fit& fit, const Linearised& linear);
/// The same for a model that nothing is fitted of but initial states.
Scored scoreAsIs(const FitProblem& problem, const Fit& fit);

/// Paired comparison of two models by block.
struct PairedTest {
  double t = 0;       ///< Student's t; positive: `with` is better
  double pValue = 1;  ///< one-sided
  double gain = 0;    ///< 1 − mean squared error with / without
};
/// On the logarithms of the blocks' errors (a model that is better where errors are small counts too) and on the errors
/// themselves (one that matters in few blocks): the more decisive of both, its p-value doubled for the choice.
PairedTest compare(const std::vector<double>& without, const std::vector<double>& with);

}  // namespace btr
