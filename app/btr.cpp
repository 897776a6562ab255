// Everything that UCHILSIM does, without a window.
#include <signal.h>

#include <cstdio>
#include <exception>

#include "app/btr_commands.h"
#include "core/spec/error.h"
#include "core/spec/process.h"
#include "core/store/database.h"

namespace {

std::atomic<bool> stopRequested{false};

// The first Ctrl-C asks for a clean stop; the second ends the program at once (nothing stored is lost by that either).
void onInterrupt(int number) {
  if (stopRequested.exchange(true)) {
    signal(number, SIG_DFL);
    raise(number);
  }
}

}  // namespace

int main(int argc, char** argv) {
  btr::beginProgram();
  struct sigaction action {};
  action.sa_handler = onInterrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);

  CLI::App app{"Back to Reality without a window: run, measure, adapt, replay, compare with recordings", "btr"};
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "btr: " + std::string(error.what()) + "; btr --help says what is possible\n";
  });
  app.set_version_flag("--version", "btr " + btr::programVersion());
  app.fallthrough();
  btr::cli::Shell shell;
  shell.stop = &stopRequested;
  app.add_flag("--json", shell.json, "machine-readable standard output");
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
  btr::cli::warnOfNetworkFiles(app);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) != 0) return btr::cli::badUsage;
    return btr::cli::closeOutput() ? btr::cli::done : btr::cli::badInput;
  } catch (const btr::NotStored& error) {
    std::fprintf(stderr, "btr: %s\n", error.what());
    return shell.goesOn ? btr::cli::stoppedEarly : btr::cli::badInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "btr: %s\n", error.what());
    return btr::cli::badInput;
  }
  return btr::cli::closeOutput() ? shell.exitCode : btr::cli::badInput;
}
