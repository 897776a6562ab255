// Everything that UCHILSIM does, without a window.
#include "app/btr_commands.h"
#include "app/cluster/btr_array.h"
#include "app/cluster/btr_cluster.h"

int main(int argc, char** argv) {
  CLI::App app{"Back to Reality without a window: run, measure, adapt, replay, compare with recordings", "btr"};
  btr::cli::Shell shell;
  btr::cli::beginCommands(app, shell);
  btr::cli::addRunCommands(app, shell);
  btr::cli::addCompareCommand(app, shell);
  btr::cli::addFitnessCommands(app, shell);
  btr::cli::addDataCommands(app, shell);
  btr::cli::addKeepCommands(app, shell);
  btr::cli::addModelCommands(app, shell);
  btr::cli::addGapCommands(app, shell);
  btr::cli::addBenchCommand(app, shell);
  btr::cli::addGaitCommands(app, shell);
  btr::cli::addGridCommands(app, shell);
  btr::cli::addLiveCommand(app, shell);
  btr::cli::addOpenrCommands(app, shell);
  btr::cli::addCameraCommand(app);
  btr::cli::addServeCommand(app);
  btr::cli::addArrayCommands(app, shell);
  btr::cli::addPiecesCommand(app, shell);
  btr::cli::warnOfNetworkFiles(app);
  if (const auto code = btr::cli::passOn(argc, argv)) return *code;
  return btr::cli::runCommands(app, shell, argc, argv);
}
