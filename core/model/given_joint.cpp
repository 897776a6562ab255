#include "core/model/given_joint.h"

#include <cmath>

#include "core/spec/figures.h"

namespace btr {

bool makeUnitAxis(Eigen::Vector3d& axis) {
  constexpr double shortest = 1e-9, fewDigits = 1e-3;
  const double length = axis.stableNorm();
  if (!std::isfinite(length) || length < shortest) return false;
  axis /= length;
  return std::abs(length - 1) >= fewDigits;
}

std::string settleMeetingLimits(Joint& joint) {
  if (joint.type == Joint::Type::fixed || joint.lower != joint.upper) return "";
  const Joint free;
  const double at = joint.lower;
  joint.lower = free.lower;
  joint.upper = free.upper;
  if (at == 0) return "both limits are 0, as of a joint to which nobody gave any: it moves without limits";
  const bool slides = joint.type == Joint::Type::slide;
  if (slides)
    joint.origin.translate(at * joint.axis);
  else
    joint.origin.rotate(Eigen::AngleAxisd(at, joint.axis));
  joint.type = Joint::Type::fixed;
  return "both limits are " + brief(at) + (slides ? " m" : " rad") + ": it is fixed there";
}

}  // namespace btr
