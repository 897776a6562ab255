#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/score.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/fit_service.h"

namespace btr {

/// A limit that the recorded motions never reach (of what an integral part adds up to, of a warming that has hardly
/// begun) is known from below only, and a fit leaves it just above what was reached. Other motions go farther: it is as
/// high as it may be, where that changes nothing of the recorded ones.
void raiseUnreached(const FitService& service, Fit& fit);

/// Sensitivities and uncertainties of a model.
struct Measurement {
  Eigen::VectorXd stepChange;  ///< of the residuals with half the step
  Linearised linear;
  Uncertainty uncertainty;
};
Measurement measure(const FitService& service, const Fit& fit);

/// A model whose unidentifiable numbers went back to what was given.
struct BackAsGiven {
  Scored scored;    ///< of the fit without them
  FitModel fitted;  ///< what is still fitted
  /// The score of a model of the same numbers and more: values from `fitted`, all else as given. They remain numbers of
  /// the fit: what is not known of them widens the intervals of others.
  Scored of(const FitModel& model) const;
};
/// In the end, numbers of the scene that are hardly identifiable are as given where that explains the recordings as
/// well: what they went elsewhere for is noise, and other motions may be sensitive to them. Nothing if none goes back.
std::optional<BackAsGiven> backAsGiven(const FitService& service, const Scored& final, const Measurement& measured);

}  // namespace btr
