// btr backup, check: the database as a file that is kept.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/run/database_check.h"
#include "core/store/database.h"
#include "core/store/network_file.h"

namespace btr::cli {
namespace {

struct KeepArguments {
  std::string database, out;
  bool force = false;
  int replays = 3;
};

void backUp(const KeepArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  const std::int64_t bytes = db.backUp(a.out, a.force);
  if (shell.json) return printJson({{"backup", a.out}, {"bytes", bytes}});
  std::printf("%s: copied to %s (%lld bytes, checked)\n", a.database.c_str(), a.out.c_str(),
              static_cast<long long>(bytes));
}

void check(const KeepArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  const DatabaseCheck found = checkDatabase(db, shell.plugins(), a.replays, *shell.stop);
  if (!found.findings.empty()) shell.exitCode = badInput;
  if (found.stopped) shell.exitCode = stoppedEarly;
  if (shell.json)
    return printJson({{"findings", found.findings}, {"replays", found.replays}, {"identical", found.identical}});
  for (const std::string& finding : found.findings) std::printf("%s\n", printable(finding).c_str());
  std::printf("%s: %s; %d of %d replays bit-identical%s\n", a.database.c_str(),
              found.findings.empty() ? "sound" : "NOT SOUND", found.identical, found.replays,
              found.stopped ? " (stopped early)" : "");
}

}  // namespace

void warnOfNetworkFiles(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    if (CLI::Option* db = command->get_option_no_throw("--db"))
      db->check(CLI::Validator(
          [](std::string& path) {
            if (const auto warning = networkWarning(path)) std::fprintf(stderr, "btr: %s\n", warning->c_str());
            return std::string();
          },
          ""));
    warnOfNetworkFiles(*command);
  }
}

void addKeepCommands(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<KeepArguments>();
  CLI::App* backup =
      app.add_subcommand("backup", "a consistent, checked copy, also while others work with the database");
  backup->add_option("--db", a->database, "experiment database")->required();
  backup->add_option("OUT", a->out, "file of the copy")->required();
  backup->add_flag("--force", a->force, "replace OUT if it is there");
  backup->callback([a, &shell] { backUp(*a, shell); });

  CLI::App* checkApp =
      app.add_subcommand("check", "is the file sound, and do individuals of each run replay bit-identically");
  checkApp->add_option("--db", a->database, "experiment database")->required();
  checkApp->add_option("--replays", a->replays, "individuals of each run that are simulated again")
      ->transform(wholeNumber(0, 1'000'000))
      ->capture_default_str();
  checkApp->callback([a, &shell] { check(*a, shell); });
}

}  // namespace btr::cli
