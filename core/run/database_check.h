#pragma once
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/loop/back_to_reality.h"
#include "core/store/database.h"

namespace btr {

struct DatabaseCheck {
  std::vector<std::string> findings;  ///< what is wrong, one sentence each
  int replays = 0, identical = 0;
  bool stopped = false;
};

/// Whether the file is sound, and whether individuals of every run, spread evenly over it, replay bit-identically.
DatabaseCheck checkDatabase(const Database& database, const PluginHost& host, int replaysOfEachRun,
                            const StopFlag& stop);

}  // namespace btr
