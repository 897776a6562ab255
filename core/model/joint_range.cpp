#include "core/model/joint_range.h"

#include <algorithm>

namespace btr {

JointRange stopsOf(const Joint& joint) {
  const double beyond = joint.type == Joint::Type::slide ? 0 : stopBeyond_rad;
  return {joint.lower - beyond, joint.upper + beyond};
}

double startOf(const Joint& joint) {
  const JointRange stops = stopsOf(joint);
  if (joint.type == Joint::Type::fixed || (stops.lower <= 0 && stops.upper >= 0)) return 0;
  return std::clamp(0.0, joint.lower, joint.upper);
}

std::vector<double> startPositions(const RobotModel& model) {
  std::vector<double> positions;
  for (const Joint& joint : model.joints) positions.push_back(startOf(joint));
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (const auto& mimic = model.joints[i].mimic)
      positions[i] = mimic->multiplier * positions[static_cast<std::size_t>(mimic->leader)] + mimic->offset;
  return positions;
}

}  // namespace btr
