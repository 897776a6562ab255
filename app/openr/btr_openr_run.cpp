// btr openr run: OPEN-R objects move robots of a game.
#include <filesystem>

#include "app/live/btr_live_run.h"
#include "core/spec/error.h"

namespace btr::cli {

void addOpenrRunCommand(CLI::App& openr, Shell& shell) {
  auto a = std::make_shared<LiveArguments>();
  a->strict = true;
  struct Pairs {
    std::vector<std::string> robots, sticks;
    bool motorPower = false, camera = false;
  };
  auto pairs = std::make_shared<Pairs>();
  CLI::App* run = openr.add_subcommand("run", "OPEN-R objects move robots of a game");
  run->add_option("--game", a->game, "game or scene (*.json), robot (*.wrl)")->required()->check(CLI::ExistingFile);
  run->add_option("--robot", pairs->robots, "a robot of the game; again for each further one")->required();
  run->add_option("--stick", pairs->sticks, "its memory stick, the folder with OPEN-R/MW in it; one for each --robot")
      ->required()
      ->check(CLI::ExistingDirectory);
  CLI::Option* seconds = run->add_option("--seconds", a->seconds, "how long, simulated [s]")
                             ->transform(decimalNumber(0, 1e6))
                             ->capture_default_str();
  run->add_option("--speed", a->speed, "simulated seconds a second; 0: as fast as possible")
      ->transform(decimalNumber(0, 1000))
      ->capture_default_str();
  run->add_flag("--motor-power", pairs->motorPower, "motors are on from the start, as if another object did it");
  run->add_flag("--camera", pairs->camera, "their cameras look (drawing takes time)");
  shell.writesFile(run,
                   run->add_option("--log", a->log, "writes what reached into the session, for btr live --replay"));
  shell.writesFile(run, run->add_option("--csv", a->csv, "writes its trace as a recording"));
  shell.writesFile(run, run->add_option("--save", a->save, "writes the game as it is at the end"));
  run->callback([a, pairs, seconds, &shell] {
    if (pairs->robots.size() != pairs->sticks.size())
      throw InputError(
          "--stick", std::to_string(pairs->sticks.size()) + " for " + std::to_string(pairs->robots.size()) + " --robot",
          "one for each");
    for (std::size_t i = 0; i < pairs->robots.size(); ++i) {
      const std::filesystem::path stick = std::filesystem::absolute(pairs->sticks[i]).lexically_normal();
      for (const OpenrChoice& other : a->sticks) {
        if (other.robot == pairs->robots[i])
          throw InputError("--robot", other.robot + " twice", "each robot once, with one stick");
        if (std::filesystem::weakly_canonical(other.stick.folder) == std::filesystem::weakly_canonical(stick))
          throw InputError("--stick", pairs->sticks[i] + " for " + other.robot + " and for " + pairs->robots[i],
                           "a folder of its own for each robot, as both write on it: copy it");
      }
      a->sticks.push_back({pairs->robots[i], {stick.string(), "", pairs->motorPower, pairs->camera}});
    }
    runLive(*a, seconds->count() > 0, shell);
  });
}

}  // namespace btr::cli
