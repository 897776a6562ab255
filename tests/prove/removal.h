#pragma once
#include <vector>

#include "core/sim/scene.h"
#include "core/spec/simulator_spec.h"
#include "tests/prove/blind_world.h"

namespace btr::prove {

/// All trials of a world, without noise, at the scene's own step: by trial one long vector of value/noise. Empty where
/// the simulation failed.
std::vector<std::vector<double>> noiseless(const BlindWorld& world, const SimulatorSpec& simulator,
                                           const EffectFactory& effects);

/// Root mean square difference, in noise floors; not a number if either failed.
double difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b);

/// What is left between `recorded` (of noiseless()) and the nearest that `simulator` can come to it when these may
/// change: the world's calibrated numbers, the parameters of the simulator's effects (but sizes that are neutral,
/// unless of the effect numbered `whole`), and where a ball begins and how fast. Levenberg–Marquardt from the values
/// given until it gains less than a thousandth: an upper bound of what is left, as a better place may lie far away. In
/// noise floors.
double leftAfterRefit(const BlindWorld& world, const SimulatorSpec& simulator, const EffectFactory& effects,
                      const std::vector<std::vector<double>>& recorded, int whole = -1);

}  // namespace btr::prove
