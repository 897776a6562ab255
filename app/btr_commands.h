#pragma once
#include <CLI/CLI.hpp>
#include <atomic>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/reality/spread.h"
#include "core/spec/figures.h"
#include "core/spec/number_options.h"

// Commands of btr. Each function adds its subcommands to the parser; their callbacks do the work and set the exit code.
namespace btr::cli {

enum ExitCode { done = 0, badInput = 1, badUsage = 2, stoppedEarly = 3, waitsForFitness = 10 };

/// How long a command that works for hours waits for another process to let go of the database.
inline constexpr int workingPatience_ms = 60000;

/// What all commands share.
struct Shell {
  bool json = false;  ///< machine-readable standard output
  int exitCode = done;
  bool goesOn = false;  ///< what is worked on is stored step by step: the same command goes on with it
  const std::atomic<bool>* stop = nullptr;  ///< raised by Ctrl-C

  /// Loaded when first needed; modules that could not be loaded are named on stderr once.
  const PluginHost& plugins();

  /// The option names a file that the command writes. It is checked before the command begins: see checkOutputFile().
  CLI::Option* writesFile(CLI::App* command, CLI::Option* option);
  /// The option names a folder that the command writes, these files among others: see checkOutputFolder().
  CLI::Option* writesFolder(CLI::App* command, CLI::Option* option, std::vector<std::string> files = {});

 private:
  struct Output {
    const CLI::Option* option;
    bool isFolder;
    std::vector<std::string> files;
  };
  CLI::Option* writes(CLI::App* command, CLI::Option* option, bool isFolder, std::vector<std::string> files);
  void checkOutputs(const CLI::App& command) const;

  std::vector<Output> outputs_;
  std::unique_ptr<PluginHost> plugins_;
};

/// Signals, and the options that all commands have; `app` has the program's name. Before its commands are added.
void beginCommands(CLI::App& app, Shell& shell);
/// Parses and runs; what is wrong becomes a line on stderr. Returns the exit code.
int runCommands(CLI::App& app, Shell& shell, int argc, char** argv);

void addRunCommands(CLI::App& app, Shell& shell);      ///< run, status, stop, stand-in
void addCompareCommand(CLI::App& app, Shell& shell);   ///< compare
void addFitnessCommands(CLI::App& app, Shell& shell);  ///< fitness list|enter|import|void, end-l2
void addDataCommands(CLI::App& app, Shell& shell);     ///< replay, export, merge
/// A database on a network file system is said to be there, on stderr, before any of these commands opens it.
void warnOfNetworkFiles(CLI::App& app);
void addKeepCommands(CLI::App& app, Shell& shell);          ///< backup, check
void addModelCommands(CLI::App& app, Shell& shell);         ///< model check, list
void addGapCommands(CLI::App& app, Shell& shell);           ///< gap residual
void addGapAdoptCommands(CLI::App& gap, Shell& shell);      ///< gap adopt|revert|versions, below "gap"
void addGapStoreCommands(CLI::App& gap, Shell& shell);      ///< gap recordings|clues
void addGapProveCommands(CLI::App& gap, Shell& shell);      ///< gap prove|tally
void addBenchCommand(CLI::App& app, Shell& shell);          ///< bench
void addGaitCommands(CLI::App& app, Shell& shell);          ///< gait check
void addGridCommands(CLI::App& app, Shell& shell);          ///< grid, grid table|map|kick
void addLiveCommand(CLI::App& app, Shell& shell);           ///< live
void addOpenrCommands(CLI::App& app, Shell& shell);         ///< openr
void addOpenrRunCommand(CLI::App& openr, Shell& shell);     ///< openr run, below "openr"
void addOpenrBuildCommands(CLI::App& openr, Shell& shell);  ///< openr build|try, below "openr"
void addCameraCommand(CLI::App& app);                       ///< camera, for the list of commands only
void addServeCommand(CLI::App& app);                        ///< serve, likewise
/// If the command is camera or serve: becomes btr-camera or btr-serve; returns, with an exit code, only if that cannot
/// be started.
std::optional<int> passOn(int argc, char** argv);

/// One JSON document on standard output. Bytes that are no UTF-8 come out as U+FFFD.
void printJson(const nlohmann::json& document);
/// Ends what was written to standard output; false, with a line on stderr, if some of it could not be.
bool closeOutput();
/// Writes to the file, or to standard output if `path` is empty.
void writeOut(const std::string& path, const std::string& text);

/// The text with control characters written out ("\\n", "\\x1b"): names from files must not steer the terminal.
std::string printable(const std::string& text);

/// Rows under a header, columns as wide as needed; numbers to the right, cells printable().
std::string table(const std::vector<std::string>& header, std::vector<std::vector<std::string>> rows);

/// "0.123 ± 0.045", the 95 % interval; empty where there is nothing.
std::string interval(const Spread& spread);

}  // namespace btr::cli
