/// Cogging: the rotor's poles and the gear's teeth pull the joint to certain angles.
///   τ = A·sin(n·q + φ)      A in N·m, n: whole number of teeth or poles per turn of the joint, q in rad
/// One term of the Fourier series of Holtz and Springob 1996 (Identification and compensation of torque ripple in
/// high-precision permanent magnet motor drives). It has an energy, A·cos(n·q + φ)/n, and takes none. On a slide joint
/// n counts per 2π m. Neutral: A = 0; n and φ then say nothing.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class TorqueRipple final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter teeth{"per_turn", "", "periods in a turn of the joint", 1, 500, 20};
    teeth.integer = true;
    return {{"amplitude_nm", "N·m", "amplitude of the torque, N on a slide joint", 0, 50, 0.03, 0.0},
            teeth,
            {"phase_rad", "rad", "phase at position 0", -3.1416, 3.1416, 0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "cogging: a torque that repeats with the angle", "τ = A·sin(n·q + φ)",
            "A: amplitude_nm; n: per_turn; φ: phase_rad", "Holtz and Springob 1996"};
  }
  Place place() const override { return Place::joint; }
  std::string periodsPerTurn() const override { return "per_turn"; }
  double torque(const btr::JointState& joint, std::span<const double> values) const override {
    return values[0] * std::sin(values[1] * joint.position + values[2]);
  }
};

}  // namespace

BTR_EFFECT(TorqueRipple, "torque_ripple")
