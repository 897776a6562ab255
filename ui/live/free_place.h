#pragma once
#include <Eigen/Core>
#include <vector>

namespace btr::ui {
class LiveWorld;

/// What an object covers of the floor, seen from above [m]: a disc, or a rectangle that is turned.
struct Footprint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double radius_m = 0;
  Eigen::Vector2d half_m = Eigen::Vector2d::Zero();  ///< of a rectangle, whose radius is 0
  double heading_rad = 0;
  /// From a point to its rim; negative inside.
  double distanceTo(const Eigen::Vector2d& point) const;
};

/// Of every object that is there now.
std::vector<Footprint> footprintsOf(const LiveWorld& world);

/// The place nearest to the wished one, on rings 2 cm apart, at which a disc touches nothing that is there; the wished
/// one if there is none within 5 m.
Eigen::Vector2d freePlace(const std::vector<Footprint>& taken, const Eigen::Vector2d& wished, double radius_m);

/// The disc that holds a dog with its head and paws.
inline constexpr double dogRadius_m = 0.2;

}  // namespace btr::ui
