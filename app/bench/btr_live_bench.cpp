#include "app/bench/btr_live_bench.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "app/bench/btr_bench_clock.h"
#include "core/live/session.h"

namespace btr::cli {
namespace {

/// Resident memory of this process [1e6 bytes].
double residentMegabytes() {
  std::ifstream statm("/proc/self/statm");
  long size = 0, resident = 0;
  statm >> size >> resident;
  return 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Only those robots.
Game withRobots(Game game, std::size_t count) {
  game.scene.robots.resize(std::min(count, game.scene.robots.size()));
  std::erase_if(game.robots, [&](const auto& player) {
    return std::ranges::none_of(game.scene.robots, [&](const RobotSpec& r) { return r.name == player.first; });
  });
  return game;
}

Game onCarpet(Game game) {
  game.scene.obstacles.clear();
  return game;
}

}  // namespace

LiveBenchRow measureLive(const LiveBenchTask& task, const PluginHost& host, double seconds,
                         const std::function<bool()>& goesOn) {
  LiveBenchRow row;
  row.name = task.name;
  Session session(task.game, host);
  for (const RobotSpec& robot : task.game.scene.robots) {
    const auto player = task.game.robots.find(robot.name);
    const bool walks = player != task.game.robots.end() && player->second.controller;
    ++(walks ? row.walking : row.standing);
  }
  const double period_s = session.scene().controlPeriod_s;
  const long second = std::max(1L, std::lround(1 / period_s)), periods = std::lround(seconds / period_s);
  for (long i = 0; i < second; ++i) session.step();
  row.before_mb = residentMegabytes();
  double middle_mb = row.before_mb;
  const double cpu = threadSeconds(), wall = wallSeconds();
  long done = 0;
  for (; done < periods && session.fault().empty(); ++done) {
    if (done % second == 0 && goesOn && !goesOn()) break;
    if (done == periods / 2) middle_mb = residentMegabytes();
    session.step();
  }
  row.simulated_s = static_cast<double>(done) * period_s;
  row.fault = session.fault();
  row.after_mb = residentMegabytes();
  row.growth_mb = row.after_mb - middle_mb;
  if (done == 0) return row;
  row.cpuPerSimulated = (threadSeconds() - cpu) / row.simulated_s;
  row.realTimeFactor = row.simulated_s / (wallSeconds() - wall);
  return row;
}

std::vector<LiveBenchTask> liveBenchTasks(const Game& twoWalkers) {
  return {{"a walking dog", onCarpet(withRobots(twoWalkers, 1))},
          {"two walking dogs", onCarpet(withRobots(twoWalkers, 2))},
          {"two on the field", withRobots(twoWalkers, 2)},
          {"six on the field", twoWalkers}};
}

std::string liveBenchTable(const std::vector<LiveBenchRow>& rows) {
  std::string table =
      "world              walk  stand  simulated s   CPU ms per simulated s   % of a core per dog   times real time"
      "   memory MB, growth in 2nd half\n";
  for (const LiveBenchRow& row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "%-18s %4d %6d %12.0f %24.2f %21.2f %17.1f %12.1f %+.1f%s\n", row.name.c_str(),
                  row.walking, row.standing, row.simulated_s, 1e3 * row.cpuPerSimulated, 1e2 * row.perDog(),
                  row.realTimeFactor, row.after_mb, row.growth_mb, row.fault.empty() ? "" : "  stopped");
    table += line;
  }
  return table + "One core, thread CPU time of physics and controllers.\n";
}

}  // namespace btr::cli
