#pragma once
#include <optional>
#include <string>

#include "core/cluster/parts.h"
#include "core/plugin/plugin_host.h"

namespace btr {

/// What this process's results hang on: the program, the libraries that it had loaded when this was first asked, and
/// the plugins, "NAME HASH" (SHA-256), sorted by name; and whether its processor fuses multiplication and addition,
/// because the mathematical library then rounds in another way. Paths play no part.
Parts buildIdentity(const PluginHost& host);

/// The same of who proves blind cases: the program that conceals them, too.
Parts buildIdentity(const PluginHost& host, const std::string& generator);

/// The first thing in which another process differs, the end of a sentence that begins with whose it is:
/// "its plugin fitness/kick.so is another one". None if they are the same.
std::optional<std::string> difference(const Parts& ours, const Parts& theirs);

}  // namespace btr
