#include "core/gap/fit/block_scores.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

std::vector<double> blockScores(const FitProblem& problem, const Eigen::VectorXd& residuals, Fold fold) {
  std::vector<double> sum(static_cast<std::size_t>(problem.blocks), 0), count(sum.size(), 0);
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      if (fold != Fold::all && segment.fold[k] != static_cast<char>(fold)) continue;
      const auto block = static_cast<std::size_t>(segment.block[k]);
      sum[block] += residuals[at] * residuals[at];
      ++count[block];
    }
  for (std::size_t b = 0; b < sum.size(); ++b) sum[b] = count[b] > 0 ? sum[b] / count[b] : -1;
  return sum;
}

}  // namespace btr
