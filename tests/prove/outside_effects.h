#pragma once
#include "core/sim/scene.h"

namespace btr::prove {

/// Physics that no plugin knows: what the analysis must call unexplained. Their names begin with "outside_".
const std::vector<std::string>& outsideNames();

/// These, and for all other names the factory given.
EffectFactory withOutside(const EffectFactory& library);

}  // namespace btr::prove
