#pragma once
#include <string>
#include <vector>

namespace btr::soak {

/// What a process holds at a moment.
struct Held {
  double after_s = 0;
  double resident_mb = 0;  ///< of this process [1e6 bytes]
  int handles = 0;         ///< open file descriptors
  int children = 0;        ///< processes, zombies included
  int threads = 0;
  int files = 0;          ///< in the folder that is worked in
  double files_mb = 0;    ///< all of them
  double largest_mb = 0;  ///< of a write-ahead log
  long individuals = 0;   ///< learned so far
  long measured = 0, replays = 0, analyses = 0;
};
Held lookAt(const std::string& folder);

/// Least squares over the second half of the looks: what grows there goes on growing.
double memoryGrowth_mb_h(const std::vector<Held>& looks);

/// For people; `every` n-th look, the first and the last.
std::string table(const std::vector<Held>& looks, std::size_t rows = 24);

/// What was lost or grows without end, one sentence each; empty: all is as it should be. Handles, processes and threads
/// are those of the first half at most, and so are files where there are looks enough: these come and go with `period`.
/// Memory may grow by `allowed_mb` over the second half.
std::vector<std::string> complaints(const std::vector<Held>& looks, std::size_t period, double allowed_mb);

}  // namespace btr::soak
