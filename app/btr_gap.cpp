// btr gap residual: recorded against simulated.
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "app/btr_commands.h"
#include "core/gap/residual.h"

namespace btr::cli {
namespace {

void residualCommand(const ResidualRequest& request, Shell& shell) {
  const bool show = isatty(STDERR_FILENO);
  bool stopped = false;
  const ResidualReport report =
      runResidual(request, shell.plugins().effectFactory(), [&](std::size_t done, std::size_t all) {
        if (show) std::fprintf(stderr, "\rreplayed %zu of %zu recordings \x1b[K", done, all);
        stopped = *shell.stop;
        return !stopped;
      });
  if (show) std::fprintf(stderr, "\n");
  std::cout << (shell.json ? toJsonText(report) : residualTable(report));
  if (stopped) shell.exitCode = stoppedEarly;
}

}  // namespace

void addGapCommands(CLI::App& app, Shell& shell) {
  CLI::App* gap = app.add_subcommand("gap", "simulated against recorded");
  gap->require_subcommand(1);
  addGapStoreCommands(*gap, shell);
  auto request = std::make_shared<ResidualRequest>();
  CLI::App* residual = gap->add_subcommand("residual", "simulate the recorded commands, report the mismatch");
  residual->add_option("SCENE.json", request->scene, "scene file")->required();
  residual->add_option("--recording", request->recordings, "recorded trial (.csv), several are several trials")
      ->required()
      ->take_all();
  residual->add_option("--mapping", request->mapping, "which column is which channel, for all recordings");
  residual->add_option("--simulator", request->simulator, "simulator version to use (simulator.json)");
  residual->add_option("--out", request->out, "folder for tables and overlay plots");
  residual->callback([request, &shell] { residualCommand(*request, shell); });
}

}  // namespace btr::cli
