// The robot's camera: what its stages do to a picture, and its numbers from photographs.
#include "app/camera/camera_commands.h"

int main(int argc, char** argv) {
  CLI::App app{"The robot's camera: what its stages do to a picture, its numbers from photographs", "btr-camera"};
  btr::cli::Shell shell;
  btr::cli::beginCommands(app, shell);
  btr::cli::addApplyCommand(app, shell);
  btr::cli::addFitCommand(app, shell);
  btr::cli::addFitColourCommand(app, shell);
  return btr::cli::runCommands(app, shell, argc, argv);
}
