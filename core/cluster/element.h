#pragma once
#include <atomic>
#include <string>

#include "core/plugin/plugin_host.h"

namespace btr {

/// Works on one element of an array job: its database (of a blind trial: its finished cases) is copied to a folder on
/// this machine's own disk ($TMPDIR, else /tmp), a btr works on it there, and it comes back into the job's folder every
/// few minutes and in the end, whole or not at all. So an element that is killed goes on from what came back last.
/// `stop`: the btr is asked to stop, and what it has done comes back. `login`: by which ssh reached this machine; then
/// its states go to standard output, too, a JSON line each. Returns true if the element is done or waits for a person,
/// or was asked to stop over ssh, where another machine would otherwise try it again. What fails stands in its state;
/// throws InputError only where not even that can be written, and for a build that differs.
bool workOnElement(const std::string& folder, std::size_t number, const PluginHost& host, const std::atomic<bool>& stop,
                   const std::string& login = {});

}  // namespace btr
