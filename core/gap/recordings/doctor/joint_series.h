#pragma once
#include <string>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Command and measured position of one joint on an even grid.
struct JointSeries {
  std::size_t robot = 0, joint = 0;
  std::string commandChannel, positionChannel;
  std::vector<double> command, position;
  std::vector<char> used;          ///< by point: switched on for half a second already
  double lowest = 0, highest = 0;  ///< position
  double commandSpread = 0, positionSpread = 0;
};

/// The joints that follow position commands and whose position was recorded, and the grid's period in `period_s`.
/// Nothing for recordings of less than 50 rows or without a rhythm that a grid could have.
std::vector<JointSeries> jointSeries(const Scene& scene, const Recording& recording, const Binding& binding,
                                     double& period_s);

}  // namespace btr
