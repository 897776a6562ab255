#pragma once
#include "core/sim/controller.h"

namespace btr {

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
