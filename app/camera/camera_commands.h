#pragma once
#include <string>
#include <vector>

#include "app/btr_commands.h"
#include "core/camera/camera_spec.h"
#include "core/camera/twin.h"
#include "core/live/game.h"
#include "core/sim/scene.h"

// Commands of btr-camera.
namespace btr::cli {

void addWatchCommand(CLI::App& app, Shell& shell);      ///< watch
void addEyeCommand(CLI::App& app, Shell& shell);        ///< eye
void addApplyCommand(CLI::App& app, Shell& shell);      ///< apply
void addFitCommand(CLI::App& app, Shell& shell);        ///< fit
void addFitColourCommand(CLI::App& app, Shell& shell);  ///< fit-colour

/// The camera that belongs to the model of a game's robot. Throws InputError if none does.
CameraSpec cameraOfRobot(const Game& game, const ModelSet& models, const std::string& robot);

/// The pictures (.png, .jpg, .jpeg, .bmp) of a folder by name. Throws InputError if there is none.
std::vector<std::string> picturesIn(const std::string& folder);

/// Prints what a fit found; `unit` is that of its errors. With --json the same as one document, `further` added.
void printTwin(const CameraTwin& twin, const std::string& unit, const Shell& shell, const nlohmann::json& further);

}  // namespace btr::cli
