#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/sim/world/world_memory.h"

namespace btr {

class JsonReader;

/// Every number exactly. Throws InputError for what is no such memory.
WorldMemory worldMemoryFromReader(JsonReader reader);
nlohmann::json toJson(const WorldMemory& memory);

}  // namespace btr
