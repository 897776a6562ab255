#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/btr_commands.h"
#include "app/live/btr_live_camera.h"
#include "core/live/game.h"

namespace btr::cli {

/// A stick for a robot.
struct OpenrChoice {
  std::string robot;
  GameStick stick;
};

/// What a running world without a window is asked for.
struct LiveArguments {
  std::string game, replay, log, csv, save, saveScene, saveExperiment, learner;
  std::optional<double> until_s{};  ///< of the world's time
  double seconds = 10, speed = 0, patience_s = 2;
  bool steered = false;
  LiveCameraOptions camera;
  std::vector<OpenrChoice> sticks;  ///< put in at the start
  bool strict = false;              ///< a program that cannot be started is an error of the input
};

/// Runs it, and says on standard output what came of it. `secondsGiven`: else a log is played to its end. Throws
/// InputError. Without a game, that of the log.
void runLive(const LiveArguments& arguments, bool secondsGiven, Shell& shell);

}  // namespace btr::cli
