#pragma once
#include <OPENR/OPENR.h>

#include <string>
#include <vector>

#include "core/openr/robot_design.h"

namespace btr::openr {

/// The robot's primitives by the numbers that programs know them by.
class Primitives {
 public:
  enum class Of { joint, sensor, lamp, other };
  struct Place {
    Of kind = Of::other;
    std::size_t place = 0;  ///< in the design's list of that kind
    Primitive primitive;
  };

  explicit Primitives(const RobotDesign& design);
  /// oprimitiveID_UNDEF if the robot has none at `locator`.
  OPrimitiveID at(const std::string& locator) const;
  const Place* find(OPrimitiveID id) const;
  OPrimitiveID idOf(Of kind, std::size_t place) const;
  OPrimitiveID idOf(Primitive::Kind kind) const;  ///< the first of its kind

 private:
  std::vector<Place> all_;
};

}  // namespace btr::openr
