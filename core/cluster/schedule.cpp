#include "core/cluster/schedule.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace btr {
namespace {

constexpr double longestPiece_s = 0.5;
/// A piece takes this many journeys at least, where there is enough to do: with a second piece at hand one is enough to
/// hide it.
constexpr double journeysPerPiece = 1;
/// A place gets this part of its fair share of what is left.
constexpr double shareOfTheRest = 0.5;
/// How fast older measurements are forgotten.
constexpr double newest = 0.2;

}  // namespace

void Pace::add(std::size_t jobs, double worked_s, double away_s) {
  if (jobs == 0) return;
  const double each = worked_s / static_cast<double>(jobs);
  job_s = job_s > 0 ? job_s + newest * (each - job_s) : each;
  // The shortest one: what is longer waited behind another piece.
  const double journey = std::max(0.0, away_s - worked_s);
  journey_s = journey_s > 0 ? std::min(journey_s, journey) : journey;
}

Schedule::Schedule(std::size_t jobs, std::size_t places) : jobs_(jobs), places_(std::max<std::size_t>(places, 1)) {}

std::vector<std::size_t> Schedule::next(const Pace& pace, std::size_t held) {
  if (held >= 2) return {};
  if (!again_.empty() && held == 0) {
    const std::size_t job = again_.front();
    again_.pop_front();
    return {job};
  }
  const std::size_t rest = jobs_ - handedOut_;
  // Beside a job that takes longer than a piece may, the journey is nothing; what waits behind it others could begin.
  if (rest == 0 || (held == 1 && (rest <= places_ || pace.job_s > longestPiece_s))) return {};
  std::size_t size = 1;
  if (pace.job_s > 0) {
    const double share = shareOfTheRest * static_cast<double>(rest) / static_cast<double>(places_);
    const double most = std::max(1.0, longestPiece_s / pace.job_s);
    // Never more than a fair share: a longer piece would hide its journey and leave other places without.
    const double least = std::min(journeysPerPiece * pace.journey_s / pace.job_s,
                                  std::ceil(static_cast<double>(rest) / static_cast<double>(places_)));
    size = static_cast<std::size_t>(std::max(1.0, std::min(most, std::max(share, least))));
  }
  size = std::min(size, rest);
  std::vector<std::size_t> piece(size);
  std::iota(piece.begin(), piece.end(), handedOut_);
  handedOut_ += size;
  return piece;
}

void Schedule::giveBack(const std::vector<std::size_t>& piece) {
  again_.insert(again_.end(), piece.begin(), piece.end());
}

}  // namespace btr
