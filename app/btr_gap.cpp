// btr gap residual: recorded against simulated.
#include <filesystem>
#include <iostream>

#include "app/btr_commands.h"
#include "core/gap/residual.h"

namespace btr::cli {
void addGapCommands(CLI::App& app, Shell& shell) {
  (void)app;
  (void)shell;
}
}  // namespace btr::cli
