#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "app/btr_commands.h"
#include "core/spec/error.h"
#include "core/spec/system/output_path.h"

namespace btr::cli {
namespace {

// What is read: arguments without a name, and these.
constexpr std::array<std::string_view, 12> reading{"--recording", "--held-out",   "--mapping", "--simulator",
                                                   "--scene",     "--report",     "--scenes",  "--camera",
                                                   "--photos",    "--renderings", "--points",  "--poses"};

// The command's own options, and those of the command that it is a part of.
std::vector<const CLI::Option*> givenTo(const CLI::App& command) {
  std::vector<const CLI::Option*> given;
  for (const CLI::App* app = &command; app; app = app->get_parent())
    for (const CLI::Option* option : app->get_options())
      if (option->count() > 0) given.push_back(option);
  return given;
}

bool isRead(const CLI::Option& option) {
  return option.get_positional() || std::ranges::count(reading, option.get_name()) > 0;
}

}  // namespace

void Shell::checkOutputs(const CLI::App& command) const {
  const std::vector<const CLI::Option*> given = givenTo(command);
  std::vector<std::string> inputs, databases;
  for (const CLI::Option* option : given) {
    if (option->get_name() == "--db") databases = option->results();
    if (isRead(*option)) inputs.insert(inputs.end(), option->results().begin(), option->results().end());
  }
  inputs = withNamedFiles(inputs);
  for (const Output& output : outputs_) {
    if (std::ranges::count(given, output.option) == 0) continue;
    for (const std::string& path : output.option->results()) {
      for (const std::string& database : databases) checkNotBesideDatabase(path, database);
      if (output.isFolder)
        checkOutputFolder(path, output.files, inputs);
      else
        checkOutputFile(path, inputs);
      // Nor may one result replace another.
      inputs.push_back(path);
    }
  }
}

CLI::Option* Shell::writes(CLI::App* command, CLI::Option* option, bool isFolder, std::vector<std::string> files) {
  outputs_.push_back({option, isFolder, std::move(files)});
  command->parse_complete_callback([this, command] { checkOutputs(*command); });
  return option;
}

CLI::Option* Shell::writesFile(CLI::App* command, CLI::Option* option) { return writes(command, option, false, {}); }

CLI::Option* Shell::writesFolder(CLI::App* command, CLI::Option* option, std::vector<std::string> files) {
  return writes(command, option, true, std::move(files));
}

}  // namespace btr::cli
