// btr replay, export, merge.
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/run/export.h"
#include "core/run/replay.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/store/database.h"

namespace btr::cli {
namespace {

struct DataArguments {
  std::string database, csv, what, from;
  Id run = 0, individual = 0;
  std::vector<Id> runs;
  std::size_t largestTrace_kib = largestKeptTrace_bytes / 1024;
};

void replayCommand(const DataArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  const Replay r = replay(db, shell.plugins(), a.run, a.individual);
  const IndividualRecord individual = db.individual(a.individual);
  if (!a.csv.empty()) writeOut(a.csv, r.result.trace.toCsv());
  if (shell.json) {
    printJson({{"individual", a.individual},
               {"generation", individual.generation},
               {"fitness", r.fitness},
               {"stored_fitness", r.storedFitness},
               {"trace_sha256", r.sha256},
               {"stored_trace_sha256", r.storedSha256},
               {"outcome", toText(r.result.outcome)},
               {"simulated_s", r.result.simulated_s},
               {"identical", r.identical}});
    return;
  }
  std::printf("individual %lld (generation %d, slot %d): fitness %.17g, stored %.17g, %s after %.3f s\n",
              static_cast<long long>(a.individual), individual.generation, individual.slot, r.fitness, r.storedFitness,
              toText(r.result.outcome), r.result.simulated_s);
  std::printf("%s\n", r.identical ? "identical to the stored run" : "DIFFERS from the stored run");
}

void exportCommand(const DataArguments& a, Shell& shell) {
  if (shell.json) throw CLI::ValidationError("--json", "export writes CSV");
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  const PreparedExperiment prepared = prepareFromRun(db.run(a.run), shell.plugins());
  writeOut(a.csv, exportCsv(db, a.run, a.what, prepared.genotype, prepared.fitness->unit()));
}

void mergeCommand(const DataArguments& a, Shell& shell) {
  Database::open(a.from, Database::Mode::readOnly);  // before a database is made for it
  Database db = Database::open(a.database, Database::Mode::create);
  const MergedRuns merged = db.merge(a.from, 1024 * a.largestTrace_kib, a.runs);
  if (shell.json)
    printJson({{"experiments", merged.experiments}, {"runs", merged.runs}, {"individuals", merged.individuals}});
  else
    std::printf("%d runs with %d individuals and %d experiments copied from %s\n", merged.runs, merged.individuals,
                merged.experiments, a.from.c_str());
}

}  // namespace

void addDataCommands(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<DataArguments>();
  const auto common = [&](CLI::App* command) {
    command->add_option("--db", a->database, "experiment database")->required();
    command->add_option("--run", a->run, "number of the run")->required()->transform(wholeNumber(1));
    shell.writesFile(command, command->add_option("--csv", a->csv, "write to this file"));
  };
  CLI::App* replayApp = app.add_subcommand("replay", "run a stored individual again; says whether it is bit-identical");
  common(replayApp);
  replayApp->add_option("--individual", a->individual, "number of the individual")
      ->required()
      ->transform(wholeNumber(1));
  replayApp->callback([a, &shell] { replayCommand(*a, shell); });

  CLI::App* exportApp = app.add_subcommand("export", "a table of a run as CSV");
  common(exportApp);
  exportApp->add_option("--what", a->what, "which table")
      ->required()
      ->check(CLI::IsMember({"generations", "individuals", "gaps", "simulators", "measurements", "policies", "steps"}));
  exportApp->callback([a, &shell] { exportCommand(*a, shell); });

  CLI::App* mergeApp = app.add_subcommand("merge", "copy the runs of another database into this one");
  mergeApp->add_option("from", a->from, "database that is read")->required();
  mergeApp->add_option("--db", a->database, "database that takes them; made if it is not there")->required();
  mergeApp
      ->add_option("--largest-trace-kib", a->largestTrace_kib, "larger traces stay behind; a replay makes them again")
      ->transform(wholeNumber(0, 1 << 20))
      ->capture_default_str();
  mergeApp->add_option("--runs", a->runs, "only these runs of it, with their experiments and recordings")
      ->transform(wholeNumber(1));
  mergeApp->callback([a, &shell] { mergeCommand(*a, shell); });
}

}  // namespace btr::cli
