#pragma once
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/live/game.h"
#include "core/plugin/plugin_host.h"

namespace btr::cli {

/// A running world whose speed is measured.
struct LiveBenchTask {
  std::string name;
  Game game;
};

/// What was measured of it; it begins after a second of simulated time, when everything has settled.
struct LiveBenchRow {
  std::string name;
  int walking = 0, standing = 0;  ///< robots with and without controller
  double simulated_s = 0;
  double cpuPerSimulated = 0;          ///< CPU seconds of its thread per simulated second, controllers included
  double realTimeFactor = 0;           ///< simulated seconds per second of wall time
  double before_mb = 0, after_mb = 0;  ///< memory of the process (resident) at the beginning and at the end [1e6 bytes]
  double growth_mb = 0;                ///< the same over the second half alone
  std::string fault;

  double perDog() const { return cpuPerSimulated / std::max(1, walking + standing); }
};

/// Runs it for so long; `goesOn` is asked every simulated second. Throws InputError as Session does.
LiveBenchRow measureLive(const LiveBenchTask& task, const PluginHost& host, double seconds,
                         const std::function<bool()>& goesOn = nullptr);

/// One walking dog on a carpet; the two of `twoWalkers` alone on the carpet and on its field; all of its dogs there.
/// `twoWalkers`: resources/games/two-walkers-2004.json.
std::vector<LiveBenchTask> liveBenchTasks(const Game& twoWalkers);

/// One table for people.
std::string liveBenchTable(const std::vector<LiveBenchRow>& rows);

}  // namespace btr::cli
