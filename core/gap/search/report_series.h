#pragma once
#include <Eigen/Core>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"

namespace btr {

/// Held-out errors of the cross-validation, by channel.
void addErrors(GapReport& report, const FitProblem& problem, const Eigen::VectorXd& residuals,
               double GapReport::Channel::*rms, double GapReport::Channel::*mae);

/// Whether the trials were fitted, never seen, or set aside as they disagree.
enum class Whose { fitted, heldOut, setAside };

/// The trials of `problem` with what was recorded and simulated; errors of those that are held out.
void addSeries(GapReport& report, const FitProblem& problem, const SearchResult& found, Whose whose);

}  // namespace btr
