// btr gap adopt, revert, versions: simulators of runs and rigs.
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_files.h"
#include "core/gap/search/report_words.h"
#include "core/run/reality/adoption.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/store/database.h"

namespace btr::cli {
namespace {

struct AdoptArguments {
  std::string database, rig, simulator, report, out;
  Id run = 0;
  int version = -1;
};

void tell(const SimulatorRecord& version, const AdoptArguments& a, Shell& shell) {
  if (shell.json) {
    nlohmann::json told{
        {"simulator", version.number},
        {"made_by", version.madeBy},
        {"evidence", version.evidence.empty() ? nlohmann::json() : nlohmann::json::parse(version.evidence)}};
    if (version.run != 0) {
      told["run"] = version.run;
      told["made_after_generation"] = version.madeAfterGeneration;
    } else {
      told["experiment"] = version.rig;
    }
    printJson(told);
    return;
  }
  std::cout << (version.run != 0 ? "run " + std::to_string(version.run) : "rig " + loadRig(a.rig).name)
            << ": simulator version " << version.number << (version.madeBy == "by hand" ? ", " : " by ")
            << originOf(version);
  if (version.run != 0) std::cout << ", used after generation " << version.madeAfterGeneration;
  std::cout << '\n';
}

void adopt(const AdoptArguments& a, Shell& shell) {
  // A rig needs no run, so its database may be a new one.
  if (!a.report.empty())
    if (const std::string warning = unseenWarning(loadReport(a.report)); !warning.empty())
      std::cerr << "btr: " << a.report << ": " << warning << '\n';
  Database db = Database::open(a.database, a.rig.empty() ? Database::Mode::readWrite : Database::Mode::create);
  tell(a.rig.empty() ? adoptFromFiles(db, shell.plugins(), a.run, a.simulator, a.report)
                     : adoptForRig(db, shell.plugins(), a.rig, a.simulator, a.report),
       a, shell);
}

void revert(const AdoptArguments& a, Shell& shell) {
  Database db = Database::open(a.database, Database::Mode::readWrite);
  const auto number = a.version < 0 ? std::nullopt : std::optional(a.version);
  tell(a.rig.empty() ? revertSimulator(db, a.run, number) : revertRig(db, requireRig(db, a.rig), number), a, shell);
}

/// The versions of a run or rig as a list, and one of them as a file that other commands take with --simulator.
void versions(const AdoptArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  if (a.rig.empty()) db.run(a.run);
  const std::vector<SimulatorRecord> all =
      a.rig.empty() ? db.simulators(a.run) : db.rigSimulators(requireRig(db, a.rig));
  if (!a.out.empty()) {
    const int number = a.version < 0 ? all.back().number : a.version;
    const auto wanted = std::ranges::find(all, number, &SimulatorRecord::number);
    if (wanted == all.end())
      throw InputError("btr gap versions --version", std::to_string(number),
                       "a version from 0 to " + std::to_string(all.back().number));
    writeFile(a.out, toJsonText(wanted->simulator));
    return tell(*wanted, a, shell);
  }
  nlohmann::json list = nlohmann::json::array();
  std::vector<std::vector<std::string>> rows;
  for (const SimulatorRecord& s : all) {
    const auto parent = std::ranges::find(all, s.parent, &SimulatorRecord::id);
    std::string effects;
    for (const PlacedEffect& e : s.simulator.effects)
      effects += (effects.empty() ? "" : ", ") + e.effect + " at " + e.at;
    list.push_back({{"simulator", s.number},
                    {"parent", parent == all.end() ? nlohmann::json() : nlohmann::json(parent->number)},
                    {"made_by", s.madeBy},
                    {"created_at", s.createdAt},
                    {"values", s.simulator.values.size()},
                    {"effects", effects}});
    rows.push_back({std::to_string(s.number), parent == all.end() ? "" : std::to_string(parent->number), originOf(s),
                    s.createdAt, std::to_string(s.simulator.values.size()), effects});
  }
  if (shell.json)
    printJson(list);
  else
    writeOut("", table({"version", "parent", "made by", "at", "numbers", "effects"}, rows));
}

}  // namespace

void addGapAdoptCommands(CLI::App& gap, Shell& shell) {
  auto a = std::make_shared<AdoptArguments>();
  const auto owner = [&](CLI::App* command) {
    command->add_option("--db", a->database, "experiment database")->required();
    CLI::Option_group* group = command->add_option_group("whose");
    group->require_option(1);
    group->add_option("--run", a->run, "number of the run")->transform(wholeNumber(1));
    group->add_option("--rig", a->rig, "a scene that no run belongs to, by its file");
  };

  CLI::App* adoptApp = gap.add_subcommand("adopt", "make a repaired simulator the newest version of a run or rig");
  owner(adoptApp);
  adoptApp->add_option("--simulator", a->simulator, "simulator.json of a gap analysis")->required();
  adoptApp->add_option("--report", a->report, "folder of the report that it comes from: the evidence");
  adoptApp->callback([a, &shell] { adopt(*a, shell); });

  CLI::App* revertApp = gap.add_subcommand("revert", "make an earlier version the newest again, as a new version");
  owner(revertApp);
  revertApp->add_option("--version", a->version, "number of the version (default: the newest one's parent)")
      ->transform(wholeNumber(0));
  revertApp->callback([a, &shell] { revert(*a, shell); });

  CLI::App* versionsApp = gap.add_subcommand("versions", "the simulator versions of a run or rig; one as a file");
  owner(versionsApp);
  CLI::Option* out = versionsApp->add_option("--out", a->out, "write a version to this file (simulator.json)");
  versionsApp->add_option("--version", a->version, "number of the version (default: the newest)")
      ->transform(wholeNumber(0))
      ->needs(out);
  shell.writesFile(versionsApp, out);
  versionsApp->callback([a, &shell] { versions(*a, shell); });
}

}  // namespace btr::cli
