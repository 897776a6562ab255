#include "ui/live/free_place.h"

#include <algorithm>
#include <cmath>

#include "ui/live/hand_acts.h"
#include "ui/live/live_world.h"

namespace btr::ui {

using Eigen::Vector2d;

double Footprint::distanceTo(const Vector2d& point) const {
  const Vector2d to = point - at;
  if (radius_m > 0) return to.norm() - radius_m;
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  const Vector2d outside(std::abs(c * to.x() + s * to.y()) - half_m.x(),
                         std::abs(c * to.y() - s * to.x()) - half_m.y());
  return outside.cwiseMax(0).norm() + std::min(0.0, outside.maxCoeff());
}

std::vector<Footprint> footprintsOf(const LiveWorld& world) {
  std::vector<Footprint> taken;
  for (const LiveObject& object : world.objects()) {
    const Eigen::Isometry3d pose = world.poseOf(object.name);
    Footprint print;
    print.at = pose.translation().head<2>();
    if (object.kind == LiveObject::Kind::obstacle) {
      print.half_m = object.half_m.head<2>();
      print.heading_rad = headingOf(pose);
    } else {
      print.radius_m = object.kind == LiveObject::Kind::robot ? object.footprint_m : object.radius_m;
    }
    taken.push_back(print);
  }
  return taken;
}

Vector2d freePlace(const std::vector<Footprint>& taken, const Vector2d& wished, double radius_m) {
  constexpr double ring_m = 0.02, furthest_m = 5, apart_m = 0.01;
  const auto isFree = [&](const Vector2d& at) {
    return std::ranges::all_of(taken,
                               [&](const Footprint& print) { return print.distanceTo(at) >= radius_m + apart_m; });
  };
  if (isFree(wished)) return wished;
  for (double way = ring_m; way < furthest_m; way += ring_m) {
    const int steps = std::max(8, int(2 * M_PI * way / ring_m));
    for (int i = 0; i < steps; ++i) {
      const double angle = 2 * M_PI * i / steps;
      const Vector2d at = wished + way * Vector2d(std::cos(angle), std::sin(angle));
      if (isFree(at)) return at;
    }
  }
  return wished;
}

}  // namespace btr::ui
