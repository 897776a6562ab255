#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/gap/fit/fit_problem.h"

namespace btr {

/// Which half of the residuals.
enum class Fold { all = -1, first = 0, second = 1 };

/// Mean squared residual of each scoring block, −1 for a block without residuals of this fold.
std::vector<double> blockScores(const FitProblem& problem, const Eigen::VectorXd& residuals, Fold fold);

}  // namespace btr
