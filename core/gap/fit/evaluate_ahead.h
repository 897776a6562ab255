#pragma once
#include <ceres/ceres.h>

#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/segment_cost.h"

namespace btr {

/// Simulates what Ceres is about to ask the costs of a fit for, all segments at once in worker processes. The same
/// numbers as without it, sooner.
class EvaluateAhead final : public ceres::EvaluationCallback {
 public:
  explicit EvaluateAhead(const FitProblem& problem) : problem_(problem) {}
  /// A cost that Ceres owns and the blocks that it depends on. Every segment has at most one.
  void add(SegmentCost& cost, const std::vector<double*>& blocks) {
    costs_.push_back({&cost, {blocks.begin(), blocks.end()}});
  }
  void PrepareForEvaluation(bool jacobians, bool newPoint) override;

 private:
  struct Asked {
    SegmentCost* cost;
    std::vector<const double*> blocks;
  };
  const FitProblem& problem_;
  std::vector<Asked> costs_;
};

}  // namespace btr
