#pragma once
#include <optional>

#include "tests/prove/blind_case.h"

namespace btr::prove {

/// What leaving an effect out must cost [noise floors] to be worth hiding it: below, nobody could miss it.
inline constexpr double leastCost = 1.2;

/// Draws an effect, its place and its size for a world: a size that moves the recordings by 2 to 100 noise floors (as
/// far as it can), drawn on a logarithmic scale. `before` is the true simulator so far; effects and places that it
/// already has are not drawn again. Nothing if the one that was drawn cannot act here.
std::optional<PlacedEffect> drawHidden(Random& random, const BlindWorld& world, const SimulatorSpec& before,
                                       const std::vector<std::string>& names, const EffectFactory& effects);

/// The same with what else the answer says of it, but for its cost.
ConcealedAnswer::Hidden describeHidden(const PlacedEffect& placed, const BlindWorld& world,
                                       const EffectFactory& effects);

/// Fills in what it costs to leave out the hidden effect `index` of `simulator` (see ConcealedAnswer).
void priceRemoval(ConcealedAnswer::Hidden& hidden, std::size_t index, const BlindWorld& world,
                  const SimulatorSpec& simulator, const Hideable& library, const EffectFactory& effects);

}  // namespace btr::prove
