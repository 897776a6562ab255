// How long a frame of a robot's camera takes, drawing and stages, from the row of the world to the bytes: CPU time of
// the whole process with the driver's threads, median and nineteen of twenty; time by the clock beside it. One game
// after the other.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "core/live/session.h"
#include "core/plugin/plugin_host.h"
#include "core/sim/scene.h"
#include "ui/live/eyes/live_eye.h"

namespace {

using namespace btr;

constexpr double simulated_s = 5;
constexpr std::size_t warmUp = 3;  // frames: the driver compiles

double cpuTime_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

ui::LiveRow rowOf(const Session& session) {
  ui::LiveRow row;
  session.sample(row.values);
  for (std::size_t i = 0; i < session.game().scene.obstacles.size(); ++i)
    if (session.game().scene.obstacles[i].mass_kg <= 0) row.fixed.emplace_back(i, session.world().obstacle(i).pose);
  return row;
}

/// Only that robot.
Game alone(Game game, const std::string& robot) {
  std::erase_if(game.scene.robots, [&](const RobotSpec& each) { return each.name != robot; });
  std::erase_if(game.robots, [&](const auto& each) { return each.first != robot; });
  return game;
}

void measure(const char* name, const Game& game, const PluginHost& host, const std::string& robot) {
  Session session(game, host);
  ui::LiveEye eye(game, loadModels(game.scene), session.channels(), robot,
                  loadCamera(SOURCE_DIR "/resources/cameras/ers7.json"));
  std::vector<double> cpu_s, wall_s;
  while (session.time_s() < simulated_s) {
    eye.add(rowOf(session));
    for (;;) {
      const double cpu = cpuTime_s(), wall = clock_s();
      if (!eye.next()) break;
      cpu_s.push_back(cpuTime_s() - cpu);
      wall_s.push_back(clock_s() - wall);
    }
    session.step();
  }
  const auto of = [](std::vector<double>& times, std::size_t twentieths) {
    std::sort(times.begin() + warmUp, times.end());
    return 1e3 * times[warmUp + (times.size() - warmUp) * twentieths / 20];
  };
  std::printf("%-22s CPU %6.2f ms, %6.2f ms   clock %6.2f ms, %6.2f ms\n", name, of(cpu_s, 10), of(cpu_s, 19),
              of(wall_s, 10), of(wall_s, 19));
}

}  // namespace

int main() {
  const PluginHost host(PLUGIN_DIR);
  const Game walkers = loadGame(SOURCE_DIR "/resources/games/two-walkers-2004.json");
  measure("the field alone", alone(walkers, "red1"), host, "red1");
  measure("a match of two", loadGame(SOURCE_DIR "/resources/games/match-2004.json"), host, "red1");
  measure("six on the field", walkers, host, "red1");
}
