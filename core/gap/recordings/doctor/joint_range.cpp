#include "core/gap/recordings/doctor/joint_range.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/spec/figures.h"

namespace btr {
namespace {

/// How far and how often a column lies beyond a limit; `side` 1: above, −1: below.
struct Beyond {
  double farthest = 0;  ///< past the limit
  std::size_t rows = 0, of = 0;
};

Beyond beyond(const std::vector<double>& column, double limit, double side, double slack) {
  Beyond found;
  for (const double value : column) {
    if (!std::isfinite(value)) continue;
    ++found.of;
    const double past = side * (value - limit);
    if (past <= slack) continue;
    ++found.rows;
    found.farthest = std::max(found.farthest, past);
  }
  return found;
}

}  // namespace

void lookAtRanges(const Scene& scene, const Recording& recording, const Binding& binding,
                  std::vector<Finding>& findings) {
  constexpr double slack_rad = 0.05, slack_m = 0.005;  // a zero that is a little off, a stop that gives
  constexpr std::size_t leastRows = 3;                 // fewer are outliers
  for (const Binding::Measured& measured : binding.measured) {
    if (measured.what != Binding::Measured::What::position) continue;
    const Joint& joint = scene.robots[measured.object].model.joints[measured.part];
    const bool slides = joint.type == Joint::Type::slide;
    const std::string& channel = recording.channels[measured.column];
    const std::string unit = slides ? " m" : " rad";
    for (const double side : {-1.0, 1.0}) {
      const double limit = side < 0 ? joint.lower : joint.upper;
      const Beyond past = beyond(recording.columns[measured.column], limit, side, slides ? slack_m : slack_rad);
      if (past.rows < leastRows) continue;
      findings.push_back(
          {channel,
           channel + " goes to " + digits(limit + side * past.farthest) + unit + ", past the joint's " +
               (side < 0 ? "lower" : "upper") + " limit of " + digits(limit) + unit + " in the model (in " +
               percent(static_cast<double>(past.rows) / static_cast<double>(past.of)) +
               " of the rows): the simulated joint stops there; give the model the limit that the joint has, " +
               "or the column its right sign, unit and zero in the mapping"});
    }
  }
}

}  // namespace btr
