#include "core/gap/beginnings.h"

#include <algorithm>

namespace btr {
namespace {

constexpr double together_s = 5, least_s = 1.5;  // of all trials, and of each: a walk steps two or three times in it
constexpr double worthIt = 1.4;

double lengthOf(const FitProblem& problem, const Segment& segment) {
  const std::vector<double>& time = problem.trials[segment.trial].recording.columns[0];
  return time[segment.last - 1] - time[segment.first];
}

Segment cut(const FitProblem& problem, const Segment& whole, double seconds) {
  const std::vector<double>& time = problem.trials[whole.trial].recording.columns[0];
  Segment part = whole;
  while (part.last > part.first + 8 && time[part.last - 1] > time[part.first] + seconds) --part.last;
  part.channel.clear();
  part.row.clear();
  part.block.clear();
  part.fold.clear();
  for (std::size_t k = 0; k < whole.row.size(); ++k) {
    if (whole.row[k] >= part.last) continue;
    part.channel.push_back(whole.channel[k]);
    part.row.push_back(whole.row[k]);
    part.block.push_back(whole.block[k]);
    part.fold.push_back(whole.fold[k]);
  }
  return part;
}

}  // namespace

std::vector<Segment> beginningsOf(const FitProblem& problem) {
  if (problem.window_s > 0 || !problem.dear || problem.segments.empty()) return problem.segments;
  const double seconds = std::max(least_s, together_s / static_cast<double>(problem.segments.size()));
  double whole_s = 0, part_s = 0;
  std::vector<Segment> parts;
  for (const Segment& segment : problem.segments) {
    parts.push_back(cut(problem, segment, seconds));
    if (parts.back().row.empty()) parts.back() = segment;  // it compares nothing so early
    whole_s += lengthOf(problem, segment);
    part_s += lengthOf(problem, parts.back());
  }
  return whole_s > worthIt * part_s ? parts : problem.segments;
}

}  // namespace btr
