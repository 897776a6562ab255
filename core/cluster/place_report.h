#pragma once
#include <string>

namespace btr {

/// How the work goes at one place: a foreman of a rank.
struct PlaceReport {
  int rank = 0, foreman = 0;
  int workers = 1;  ///< its worker processes
  std::string host;
  long pieces = 0, jobs = 0, losses = 0;
  double worked_s = 0;  ///< in its worker, by the clock
};

}  // namespace btr
