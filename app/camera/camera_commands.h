#pragma once
#include <string>
#include <vector>

#include "app/btr_commands.h"
#include "core/camera/twin.h"

// Commands of btr-camera.
namespace btr::cli {

void addWatchCommand(CLI::App& app, Shell& shell);      ///< watch
void addApplyCommand(CLI::App& app, Shell& shell);      ///< apply
void addFitCommand(CLI::App& app, Shell& shell);        ///< fit
void addFitColourCommand(CLI::App& app, Shell& shell);  ///< fit-colour

/// The pictures (.png, .jpg, .jpeg, .bmp) of a folder by name. Throws InputError if there is none.
std::vector<std::string> picturesIn(const std::string& folder);

/// Prints what a fit found; `unit` is that of its errors. With --json the same as one document, `further` added.
void printTwin(const CameraTwin& twin, const std::string& unit, const Shell& shell, const nlohmann::json& further);

}  // namespace btr::cli
