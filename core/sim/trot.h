#pragma once
#include <array>

#include "core/sim/controller.h"

namespace btr {

/// Angles of a three-joint leg [rad], OPEN-R signs: J1 positive swings the foot away from the body's middle, J2
/// outward, J3 folds the knee the way of J1.
using LegAngles = std::array<double, 3>;

/// A leg of two crossed hip joints and a knee, in the hip's frame: x forward, y OUTWARD (right legs mirrored), z up.
///   foot(t1, t2, t3) = Ry(−s·t1)·Rx(t2)·(knee + Ry(−s·t3)·shank)     s = +1 front, −1 rear; Ry turns z into x
struct LegGeometry {
  Eigen::Vector3d knee = Eigen::Vector3d::Zero();   ///< hip → knee at zero [m]
  Eigen::Vector3d shank = Eigen::Vector3d::Zero();  ///< knee → contact point of the foot at zero [m]
  double side = 1;                                  ///< s

  Eigen::Vector3d foot(const LegAngles& angles) const;
  /// Closed-form inverse: the angles that put the foot there, the knee folded the way that is nearer to `last`. A point
  /// out of reach is replaced by the nearest one the leg can reach; `reached` tells.
  LegAngles angles(const Eigen::Vector3d& foot, const LegAngles& last, bool& reached) const;
};

/// A plain trot with half-ellipse loci: diagonal pairs half a cycle apart, feet dragged back along a straight line for
/// half of it. What the speed measurements walk with; not meant to evolve. Parameters: none.
///   settings: cycle_s, stride_m, lift_m, duration_s
class Trot final : public Controller {
 public:
  std::vector<Parameter> genotype() const override { return {}; }
  std::vector<Parameter> settings() const override;
  /// Stands the robot at the first points of its loci. Throws InputError for a robot without four such legs.
  void arrange(Scene& scene, const Values& settings) const override;
  std::unique_ptr<Motion> begin(const Scene& scene, const Values& settings,
                                std::span<const double> parameters) const override;
};

}  // namespace btr
