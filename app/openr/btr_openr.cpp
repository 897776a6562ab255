// btr openr: programs for Sony's robots, made and run.
#include "app/btr_commands.h"

namespace btr::cli {

void addOpenrCommands(CLI::App& app, Shell& shell) {
  CLI::App* openr =
      app.add_subcommand("openr", "OPEN-R programs, unmodified: build them, run them on simulated robots");
  openr->require_subcommand(1);
  addOpenrBuildCommands(*openr, shell);
  addOpenrRunCommand(*openr, shell);
}

}  // namespace btr::cli
