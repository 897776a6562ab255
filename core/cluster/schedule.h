#pragma once
#include <cstddef>
#include <deque>
#include <vector>

namespace btr {

/// What was measured of the jobs so far; 0: not yet.
struct Pace {
  double job_s = 0;      ///< what one job takes where it is worked on
  double journey_s = 0;  ///< what a piece takes beyond its jobs: the way there and back, writing and reading it
  /// Takes a piece into account: so many jobs, what they took there, and what the piece took from here.
  void add(std::size_t jobs, double worked_s, double away_s);
};

/// Which jobs go to which place: numbered jobs, all worth the same, in pieces sized by measured time. A piece is so
/// long that its journey is short beside it, so short that places end together: a part of what is left (so that pieces
/// become shorter towards the end) and never longer than half a second. Knows no clock, no network and no results.
class Schedule {
 public:
  Schedule(std::size_t jobs, std::size_t places);

  /// The next piece for a place that holds `held` pieces; empty: nothing for it now. A place gets a second piece before
  /// it has ended the first, so that it need not wait for the journey, unless others have none or a job takes longer
  /// than half a second.
  std::vector<std::size_t> next(const Pace& pace, std::size_t held);
  /// Jobs whose place was lost are handed out first, each in a piece of its own.
  void giveBack(const std::vector<std::size_t>& piece);
  std::size_t left() const { return jobs_ - handedOut_ + again_.size(); }

 private:
  std::size_t jobs_, places_, handedOut_ = 0;
  std::deque<std::size_t> again_;
};

}  // namespace btr
