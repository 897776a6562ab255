// The robot's camera: its frames of a running world, what its stages do to a picture, its numbers from photographs.
#include <QCoreApplication>
#include <iostream>

#include "app/camera/camera_commands.h"

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);       // worlds are told in long lines
  const QCoreApplication qt(argc, argv);  // it knows where the resources are
  CLI::App app{
      "The robot's camera: frames of a running world, what its stages do to a picture, its numbers from photographs",
      "btr-camera"};
  btr::cli::Shell shell;
  btr::cli::beginCommands(app, shell);
  btr::cli::addWatchCommand(app, shell);
  btr::cli::addEyeCommand(app, shell);
  btr::cli::addApplyCommand(app, shell);
  btr::cli::addFitCommand(app, shell);
  btr::cli::addFitColourCommand(app, shell);
  return btr::cli::runCommands(app, shell, argc, argv);
}
