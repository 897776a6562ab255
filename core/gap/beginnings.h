#pragma once
#include <vector>

#include "core/gap/fit_problem.h"

namespace btr {

/// The segments of a problem that is dear to simulate (a robot that walks, whose trials run freely from their starts),
/// each cut to its first seconds: a joint moves there and back several times in them, and what follows hangs on what
/// happened there. Numbers of the segments stay. All of them whole where that would save little, and for any other
/// problem: in windows each says something else.
std::vector<Segment> beginningsOf(const FitProblem& problem);

/// Exchanges a problem's segments for their beginnings as long as it lives.
class OnBeginnings {
 public:
  explicit OnBeginnings(FitProblem& problem) : problem_(problem), whole_(problem.segments) {
    problem.segments = beginningsOf(problem);
  }
  ~OnBeginnings() { problem_.segments = std::move(whole_); }
  OnBeginnings(const OnBeginnings&) = delete;
  OnBeginnings& operator=(const OnBeginnings&) = delete;

 private:
  FitProblem& problem_;
  std::vector<Segment> whole_;
};

}  // namespace btr
