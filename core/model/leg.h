#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>

namespace btr {

/// Angles of a three-joint leg [rad], OPEN-R signs: J1 positive swings the foot away from the body's middle, J2
/// outward, J3 folds the knee the way of J1.
using LegAngles = std::array<double, 3>;

/// Least and largest angles of a leg's joints [rad].
struct LegLimits {
  LegAngles lower{-noLimit, -noLimit, -noLimit}, upper{noLimit, noLimit, noLimit};
  static constexpr double noLimit = std::numeric_limits<double>::infinity();

  bool allow(const LegAngles& angles) const;
};

/// What inverse kinematics found.
struct LegSolution {
  LegAngles angles{};
  bool reached = true;       ///< false: the point lay out of reach; the leg is stretched or folded towards it
  bool withinLimits = true;  ///< false: no solution kept the limits; of the one that broke them least each angle was
                             ///< clamped by itself, which is not the nearest point that the foot could take

  bool feasible() const { return reached && withinLimits; }
};

/// A leg of two crossed hip joints and a knee, in the hip's frame: x forward, y OUTWARD (right legs mirrored), z up.
///   foot(t1, t2, t3) = Ry(−s·t1)·Rx(t2)·(knee + Ry(−s·t3)·shank)     s = +1 front, −1 rear; Ry turns z into x
struct LegGeometry {
  Eigen::Vector3d knee = Eigen::Vector3d::Zero();   ///< hip → knee at zero [m]
  Eigen::Vector3d shank = Eigen::Vector3d::Zero();  ///< knee → foot at zero [m]
  double side = 1;                                  ///< s

  Eigen::Vector3d foot(const LegAngles& angles) const;

  /// Closed-form inverse with all offsets. With p the foot, U = knee, L = shank:
  ///   t3 from A·sin t3 + B·cos t3 = K,   K = (|p|² − |U|² − |L|²)/2 − Uy·Ly, A = −s(Ux·Lz − Uz·Lx), B = Ux·Lx + Uz·Lz
  ///   t2 from qy·cos t2 − qz·sin t2 = py,   q = U + Ry(−s·t3)·L
  ///   t1 = s·(atan2(px, −pz) − atan2(wx, −wz)),   w = Rx(t2)·q
  /// Each of the first two has two roots. Of the solutions within `limits` the one nearest to `last` is taken.
  LegSolution solve(const Eigen::Vector3d& foot, const LegAngles& last, const LegLimits& limits = {}) const;
};

}  // namespace btr
