// btr gap recordings, clues: what gap analysis takes from the database and keeps in it.
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/btr_commands.h"
#include "app/progress_line.h"
#include "core/run/reality/fitness_clues.h"
#include "core/run/reality/rig.h"
#include "core/run/reality/stored_recordings.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/cancelled.h"
#include "core/store/database.h"

namespace btr::cli {
namespace {

struct StoreArguments {
  std::string database, mapping, scene, rig, out;
  std::vector<std::string> files;
  std::vector<Id> recordings;
  Id run = 0, experiment = 0, individual = 0;
};

/// Recordings belong to an experiment, which a rig is, too; a run names the one that it is of.
Id experimentOf(const Database& db, const StoreArguments& a) {
  if (!a.rig.empty()) return requireRig(db, a.rig);
  if (a.run != 0) return db.run(a.run).experiment;
  if (a.experiment != 0) return db.experiment(a.experiment).id;
  const auto all = db.experiments();
  if (all.size() == 1) return all.front().id;
  throw InputError("btr gap recordings: give --run, --experiment or --rig; the database has " +
                   std::to_string(all.size()) + " experiments");
}

void import(const StoreArguments& a, Shell& shell) {
  if (!a.rig.empty() && a.individual != 0)
    throw InputError("--individual", std::to_string(a.individual), "none with --rig: individuals belong to runs");
  const std::string scene = a.scene.empty() ? a.rig : a.scene;
  std::optional<Rig> rig;
  std::optional<Database> db;
  Id experiment = 0;
  if (!a.rig.empty()) {
    rig = loadRig(a.rig);
  } else {
    db = Database::open(a.database, Database::Mode::readWrite);
    experiment = experimentOf(*db, a);
  }
  nlohmann::json all = nlohmann::json::array();
  for (const std::string& file : a.files) {
    CheckedRecording checked = checkRecording(file, a.mapping, scene);
    if (!db) {  // a rig comes with the first recording that is fit to be kept, and its database may be a new one
      db = Database::open(a.database, Database::Mode::create);
      experiment = addRig(*db, *rig);
    }
    const StoredRecording stored = keepRecording(*db, experiment, std::move(checked), a.individual);
    all.push_back({{"recording", stored.id},
                   {"file", file},
                   {"new", stored.isNew},
                   {"trials", stored.trials},
                   {"rows", stored.rows},
                   {"notes", stored.notes}});
    if (shell.json) continue;
    std::cout << file << ": " << (stored.isNew ? "stored as recording " : "is there already as recording ") << stored.id
              << ", " << stored.rows << " rows\n";
    for (const std::string& note : stored.notes) std::cout << "  note: " << note << '\n';
  }
  if (shell.json) printJson(all);
}

void list(const StoreArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  nlohmann::json all = nlohmann::json::array();
  std::vector<std::vector<std::string>> rows;
  for (const RecordingRecord& r : db.recordings(experimentOf(db, a))) {
    all.push_back({{"recording", r.id},
                   {"experiment", r.experiment},
                   {"individual", r.individual == 0 ? nlohmann::json() : nlohmann::json(r.individual)},
                   {"name", r.name},
                   {"sha256", r.sha256},
                   {"mapped", !r.mappingJson.empty()},
                   {"source", r.source},
                   {"added_at", r.addedAt}});
    rows.push_back({std::to_string(r.id), r.name, r.individual == 0 ? "" : std::to_string(r.individual),
                    r.mappingJson.empty() ? "no" : "yes", r.sha256.substr(0, 12), r.addedAt});
  }
  if (shell.json)
    printJson(all);
  else if (rows.empty())
    std::cout << "no recordings\n";
  else
    writeOut("", table({"recording", "name", "individual", "mapping", "SHA-256", "added"}, rows));
}

void exportThem(const StoreArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  nlohmann::json all = nlohmann::json::array();
  for (const Id recording : a.recordings) {
    const std::string file = exportRecording(db, recording, a.out);
    all.push_back({{"recording", recording}, {"file", file}});
    if (!shell.json) std::cout << file << '\n';
  }
  if (shell.json) printJson(all);
}

struct ClueArguments {
  std::string database;
  Id run = 0;
  bool lines = false;
  FitnessCluesOptions options;
};

void clues(const ClueArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  ProgressLine progress(shell, a.lines);
  FitnessCluesOptions options = a.options;
  options.progress = progress;
  try {
    const FitnessClues found = fitnessClues(db, shell.plugins(), a.run, options);
    progress.end();
    if (shell.json) {
      std::cout << toJsonText(found) << '\n';
      return;
    }
    std::cout << found.sentence << "\n\n";
    std::vector<std::vector<std::string>> rows;
    for (const FitnessClue& clue : found.clues) {
      if (rows.size() == 20) break;
      std::string sizes;
      for (const auto& [name, value] : clue.effect.parameters)
        sizes += (sizes.empty() ? "" : ", ") + name + " " + brief(value);
      rows.push_back({clue.effect.effect, clue.effect.at, brief(100 * clue.share) + " %", brief(clue.pValue), sizes});
    }
    writeOut("", table({"effect", "at", "takes away", "p by chance", "size"}, rows));
  } catch (const Cancelled&) {
    progress.end();
    std::fprintf(stderr, "stopped\n");
    shell.exitCode = stoppedEarly;
  }
}

void addClues(CLI::App& gap, Shell& shell) {
  auto a = std::make_shared<ClueArguments>();
  CLI::App* app = gap.add_subcommand("clues", "what measured fitness alone says of missing physics");
  app->add_option("--db", a->database, "experiment database")->required();
  app->add_option("--run", a->run, "number of the run")->required()->transform(wholeNumber(1));
  app->add_option("--effects", a->options.names, "consider only these")->take_all();
  app->add_option("--jobs", a->options.workers, "worker processes")->transform(wholeNumber(1, 256));
  app->add_option("--seed", a->options.seed, "of the differences dealt out at random")
      ->transform(seedNumber())
      ->capture_default_str();
  app->add_flag("--progress", a->lines, "a line STAGE SHARE on standard error at every step");
  app->callback([a, &shell] { clues(*a, shell); });
}

}  // namespace

void addGapStoreCommands(CLI::App& gap, Shell& shell) {
  addClues(gap, shell);
  auto a = std::make_shared<StoreArguments>();
  const auto database = [&](CLI::App* command) {
    command->add_option("--db", a->database, "experiment database")->required();
  };
  const auto owner = [&](CLI::App* command) {
    database(command);
    CLI::Option_group* group = command->add_option_group("whose");
    group->require_option(0, 1);
    group->add_option("--run", a->run, "number of a run of the experiment")->transform(wholeNumber(1));
    group->add_option("--experiment", a->experiment, "number of the experiment")->transform(wholeNumber(1));
    group->add_option("--rig", a->rig, "a scene that no run belongs to, by its file");
  };
  CLI::App* recordings = gap.add_subcommand("recordings", "recordings kept in the database");
  recordings->require_subcommand(1);
  CLI::App* importApp = recordings->add_subcommand("import", "check recordings and keep them");
  owner(importApp);
  importApp->add_option("RECORDING.csv", a->files, "recorded trials")->required();
  importApp->add_option("--mapping", a->mapping,
                        "which column is which channel (default: the one beside the file, else beside the scene)");
  importApp->add_option("--scene", a->scene,
                        "the scene whose SCENE.mapping.json counts for files without one (--rig: that one's)");
  importApp->add_option("--individual", a->individual, "number of the individual that was recorded")
      ->transform(wholeNumber(1));
  importApp->callback([a, &shell] { import(*a, shell); });
  CLI::App* listApp = recordings->add_subcommand("list", "what is kept");
  owner(listApp);
  listApp->callback([a, &shell] { list(*a, shell); });
  CLI::App* exportApp = recordings->add_subcommand("export", "write recordings and mappings into a folder");
  database(exportApp);
  exportApp->add_option("--recording", a->recordings, "numbers of the recordings")
      ->required()
      ->transform(wholeNumber(1));
  shell.writesFolder(exportApp, exportApp->add_option("--out", a->out, "the folder")->required());
  exportApp->callback([a, &shell] { exportThem(*a, shell); });
}

}  // namespace btr::cli
