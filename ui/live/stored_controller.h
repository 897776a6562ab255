#pragma once
#include <string>

#include "core/live/game.h"
#include "core/store/records.h"

namespace btr {
class PluginHost;
}
namespace btr::ui {

/// A stored individual as a game's controller: the run's plugin with its settings, the individual's parameters. Of a
/// run of OPEN-R programs it is the run's stick: a copy in a new folder below `sticks`, with the individual's
/// PARAMS.TXT; it stays, since games that are saved name it. Throws InputError for a plugin that is not there or that
/// has other parameters now, and for a stick that cannot be copied.
GameController storedController(const RunRecord& run, const IndividualRecord& individual, const PluginHost& host,
                                const std::string& sticks);

}  // namespace btr::ui
