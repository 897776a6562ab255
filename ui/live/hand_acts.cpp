#include "ui/live/hand_acts.h"

#include <cmath>

namespace btr::ui {

double headingOf(const Eigen::Isometry3d& pose) { return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)); }

PlaceAct placeAct(const std::string& object, const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  const Eigen::Vector3d p = pose.translation();
  return {object, {p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}, {}};
}

std::vector<ParameterAct> differences(const std::string& robot, std::span<const Parameter> declared, const Values& from,
                                      const Values& to) {
  std::vector<ParameterAct> acts;
  for (const Parameter& parameter : declared) {
    const double wanted = valueOf(declared, to, parameter.name);
    if (wanted != valueOf(declared, from, parameter.name)) acts.push_back({robot, parameter.name, wanted});
  }
  return acts;
}

}  // namespace btr::ui
