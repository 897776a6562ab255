// btr live: a running world without a window.
#include "app/live/btr_live_run.h"

namespace btr::cli {

void addLiveCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<LiveArguments>();
  CLI::App* live = app.add_subcommand("live", "a running world: a game, a scene, or a robot on a floor");
  live->add_option("game", a->game, "game or scene (*.json), robot (*.wrl, *.urdf)")
      ->required()
      ->check(CLI::ExistingFile);
  CLI::Option* seconds = live->add_option("--seconds", a->seconds, "how long, simulated [s]")
                             ->transform(decimalNumber(0, 1e6))
                             ->capture_default_str();
  live->add_option("--speed", a->speed, "simulated seconds a second; 0: as fast as possible")
      ->transform(decimalNumber(0, 1000))
      ->capture_default_str();
  live->add_option("--replay", a->replay, "log of a session of this game, to be played again")
      ->check(CLI::ExistingFile);
  shell.writesFile(live, live->add_option("--log", a->log, "writes what reached into the session"));
  shell.writesFile(live, live->add_option("--csv", a->csv, "writes its trace as a recording"));
  addCameraOptions(*live, a->camera, shell);
  shell.writesFile(live, live->add_option("--save", a->save, "writes the game as it is at the end"));
  shell.writesFile(live, live->add_option("--save-scene", a->saveScene,
                                          "writes where everything is at the end as a scene of its own"));
  live->add_option("--patience", a->patience_s, "how long a controller may take for one control period [s]")
      ->transform(decimalNumber(0.01, 1e6))
      ->capture_default_str();
  live->add_flag("--steered", a->steered, "obeys lines of JSON on standard input, answers on standard output")
      ->excludes(seconds);
  live->callback([a, seconds, &shell] { runLive(*a, seconds->count() > 0, shell); });
}

}  // namespace btr::cli
