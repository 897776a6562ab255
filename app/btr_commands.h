#pragma once
#include <CLI/CLI.hpp>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/spread.h"

// Commands of btr. Each function adds its subcommands to the parser; their callbacks do the work and set the exit code.
namespace btr::cli {

enum ExitCode { done = 0, badInput = 1, badUsage = 2, stoppedEarly = 3, waitsForFitness = 10 };

/// What all commands share.
struct Shell {
  bool json = false;  ///< machine-readable standard output
  int exitCode = done;
  const std::atomic<bool>* stop = nullptr;  ///< raised by Ctrl-C

  /// Loaded when first needed; modules that could not be loaded are named on stderr once.
  const PluginHost& plugins();

 private:
  std::unique_ptr<PluginHost> plugins_;
};

void addRunCommands(CLI::App& app, Shell& shell);      ///< run, status, stop, stand-in
void addCompareCommand(CLI::App& app, Shell& shell);   ///< compare
void addFitnessCommands(CLI::App& app, Shell& shell);  ///< fitness list|enter|import
void addDataCommands(CLI::App& app, Shell& shell);     ///< replay, export, merge
void addModelCommands(CLI::App& app, Shell& shell);    ///< model check, list
void addGapCommands(CLI::App& app, Shell& shell);      ///< gap residual
/// gap adopt|revert|recordings, below "gap"
void addGapStoreCommands(CLI::App& gap, Shell& shell);
void addGapProveCommand(CLI::App& gap, Shell& shell);  ///< gap prove
void addBenchCommand(CLI::App& app, Shell& shell);     ///< bench
void addGaitCommands(CLI::App& app, Shell& shell);     ///< gait check
void addGridCommands(CLI::App& app, Shell& shell);     ///< grid, grid table|map|kick

/// Writes to the file, or to standard output if `path` is empty.
void writeOut(const std::string& path, const std::string& text);

/// Rows under a header, columns as wide as needed; numbers to the right.
std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

/// Four significant digits for people.
std::string brief(double value);
/// "0.123 ± 0.045", the 95 % interval; empty where there is nothing.
std::string interval(const Spread& spread);

}  // namespace btr::cli
