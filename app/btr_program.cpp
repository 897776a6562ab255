// What every program with commands does around them: signals, parsing, one line for each error, exit codes.
#include <signal.h>

#include <cstdio>
#include <exception>

#include "app/already_said.h"
#include "app/btr_commands.h"
#include "core/spec/error.h"
#include "core/spec/system/process.h"
#include "core/store/database.h"

namespace btr::cli {
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

void beginCommands(CLI::App& app, Shell& shell) {
  beginProgram();
  struct sigaction action {};
  action.sa_handler = onInterrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  shell.stop = &stopRequested;

  const std::string name = app.get_name();
  app.require_subcommand(1);
  app.failure_message([name](const CLI::App*, const CLI::Error& error) {
    return name + ": " + std::string(error.what()) + "; " + name + " --help says what is possible\n";
  });
  app.set_version_flag("--version", name + " " + programVersion());
  app.fallthrough();
  app.add_flag("--json", shell.json, "machine-readable standard output");
}

int runCommands(CLI::App& app, Shell& shell, int argc, char** argv) {
  const std::string name = app.get_name();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) != 0) return badUsage;
    return closeOutput() ? done : badInput;
  } catch (const AlreadySaid&) {
    return badInput;
  } catch (const NotStored& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return shell.goesOn ? stoppedEarly : badInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return badInput;
  }
  return closeOutput() ? shell.exitCode : badInput;
}

}  // namespace btr::cli
