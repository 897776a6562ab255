// btr live: a running world without a window.
#include "app/live/btr_live_run.h"

namespace btr::cli {

void addLiveCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<LiveArguments>();
  CLI::App* live = app.add_subcommand("live", "a running world: a game, a scene, or a robot on a floor");
  CLI::Option* game =
      live->add_option("game", a->game, "game or scene (*.json), robot (*.wrl, *.urdf); none: that of the log")
          ->check(CLI::ExistingFile);
  CLI::Option* seconds = live->add_option("--seconds", a->seconds, "how long, simulated [s]")
                             ->transform(decimalNumber(0, 1e6))
                             ->capture_default_str();
  CLI::Option* until = live->add_option("--until", a->until_s, "to which time of the world [s]")
                           ->transform(decimalNumber(0, 1e7))
                           ->excludes(seconds);
  live->add_option("--speed", a->speed, "simulated seconds a second; 0: as fast as possible")
      ->transform(decimalNumber(0, 1000))
      ->capture_default_str();
  CLI::Option* replay =
      live->add_option("--replay", a->replay, "log of a session, to be played again")->check(CLI::ExistingFile);
  shell.writesFile(live, live->add_option("--log", a->log, "writes what reached into the session"));
  shell.writesFile(live, live->add_option("--csv", a->csv, "writes its trace as a recording"));
  addCameraOptions(*live, a->camera, shell);
  shell.writesFile(live, live->add_option("--save", a->save, "writes the game as it is at the end"));
  shell.writesFile(live, live->add_option("--save-scene", a->saveScene,
                                          "writes where everything is at the end as a scene of its own"));
  CLI::Option* experiment = live->add_option("--save-experiment", a->saveExperiment,
                                             "writes an experiment that begins where everything is at the end");
  shell.writesFile(live, experiment);
  live->add_option("--learner", a->learner, "robot that learns in it")->needs(experiment);
  live->add_option("--patience", a->patience_s, "how long a controller may take for one control period [s]")
      ->transform(decimalNumber(0.01, 1e6))
      ->capture_default_str();
  // Who steers is told each row: a table or a video of what others do is theirs to write.
  live->add_flag("--steered", a->steered, "obeys lines of JSON on standard input, answers on standard output")
      ->excludes(seconds)
      ->excludes(until)
      ->excludes(live->get_option("--csv"))
      ->excludes(live->get_option("--camera"));
  live->callback([=, &shell] {
    if (game->count() == 0 && replay->count() == 0) throw CLI::RequiredError("game, or --replay with a log,");
    runLive(*a, seconds->count() > 0, shell);
  });
}

}  // namespace btr::cli
