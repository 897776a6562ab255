#pragma once
#include <string>
#include <vector>

#include "core/live/game.h"
#include "core/plugin/plugin_host.h"

namespace btr {

/// The controller's parameters as a vector; throws InputError, beginning with `place`.
std::vector<double> parametersOf(const Controller& controller, const GameController& spec, const std::string& place);

/// What playing would say of a game later: a controller that is not there, settings or parameters out of bounds. Throws
/// InputError.
void checkPlayers(const Game& game, const PluginHost& host);

}  // namespace btr
