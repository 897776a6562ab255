#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/live/session.h"

namespace btr::cli {

/// What is told of a session, see manual/formats/game.md: its objects, and where they are now. Whoever tells adds what
/// he knows of how it runs.
nlohmann::json gameLine(const Session& session);
/// What stands so deep in something else that it will be thrown out, a sentence each.
std::vector<std::string> overlapsIn(const Session& session);
nlohmann::json rowLine(const Session& session, bool playing, double realTimeFactor);

}  // namespace btr::cli
