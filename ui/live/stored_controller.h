#pragma once
#include "core/live/game.h"
#include "core/store/records.h"

namespace btr {
class PluginHost;
}
namespace btr::ui {

/// A stored individual as a game's controller: the run's plugin with its settings, the individual's parameters. Throws
/// InputError for a plugin that is not there or that has other parameters now.
GameController storedController(const RunRecord& run, const IndividualRecord& individual, const PluginHost& host);

}  // namespace btr::ui
