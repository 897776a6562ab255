#pragma once
#include <cstddef>
#include <string>

namespace btr {

// Which plugin a crash happened in. A fatal signal walks the stack; the innermost frame that lies in the code of a
// plugin names it, whether the plugin itself failed or what it called.

/// The code of [begin, end) belongs to `name`, e.g. "the controller plugin \"kick\"". Kept until the process ends.
void rememberCode(const void* begin, const void* end, const std::string& name);

/// What a crash writes before the process ends by the same signal: called with "the controller plugin "kick" crashed
/// (signal 11)", not called where no plugin is on the stack. Only what a signal handler may do.
using CrashTeller = void (*)(const char* text, std::size_t size);

/// From now on crashes are reported; only signals that nobody else handles if `unlessHandled` (a sanitizer, say).
void tellCrashes(CrashTeller tell, bool unlessHandled);

}  // namespace btr
