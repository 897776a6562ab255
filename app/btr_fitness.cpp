// btr fitness list, enter, import, void, and end-l2: real fitness, measured by a person.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "core/run/reality/measured_import.h"
#include "core/run/reality/plausibility.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/reality/resting_simulator.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/store/database.h"

namespace btr::cli {
namespace {

struct FitnessArguments {
  std::string database, note, file;
  Id run = 0, individual = 0, measurement = 0;
  std::vector<double> values;
  bool isVoid = false, counts = false, showSimulated = false, hasNote = false, yes = false;
};

std::string operatorName() {
  const char* name = std::getenv("USER");
  return name ? name : "";
}

// A typed value is in the file itself when the command is over, not in the log beside it: people copy only the file.
void keepInFile(const Database& db) {
  if (!db.moveLogIntoFile())
    std::fprintf(stderr,
                 "btr: %s: stored, but another process reads an older state, so that the value still stands in the log "
                 "beside the file; copy with btr backup\n",
                 db.path().c_str());
}

void list(const FitnessArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  const RunRecord run = db.run(a.run);
  const std::string unit = prepareFromRun(run, shell.plugins()).fitness->unit();
  const std::vector<MeasurementRecord> measured = db.measurements(a.run);
  nlohmann::json all = nlohmann::json::array();
  std::vector<std::vector<std::string>> rows;
  const std::vector<MeasurementTask> tasks = db.measurementTasks(a.run);
  const std::vector<RealityIteration> finished = db.realityIterations(a.run);
  const int iteration = tasks.empty() ? 0 : tasks.back().iteration;  // of L2; 0: the stage's own measurement waits
  for (const MeasurementTask& task : tasks) {
    if (isOver(task, finished)) continue;
    nlohmann::json values = nlohmann::json::array();
    std::string text;
    int have = 0, valid = 0;
    for (const MeasurementRecord& m : measured) {
      if (m.individual != task.individual) continue;
      ++have;
      valid += !m.isVoid;
      values.push_back(
          {{"measurement", m.id}, {"value", m.value}, {"void", m.isVoid}, {"note", m.note}, {"source", m.source}});
      text += (text.empty() ? "" : " ") + brief(m.value) + (m.isVoid ? " (void)" : "");
    }
    const bool isOpen = task.stage == run.stage + 1 && task.iteration == iteration;
    if (!isOpen && have >= task.wantedRepeats) continue;
    // The simulated fitness stays hidden, so that nobody measures what he expects.
    nlohmann::json row{{"stage", task.stage},
                       {"iteration", task.iteration},
                       {"position", task.position},
                       {"individual", task.individual},
                       {"unit", unit},
                       {"wanted_repeats", task.wantedRepeats},
                       {"measured", valid},
                       {"values", values},
                       {"held_out", task.heldOut}};
    row["reason"] = reasonOf(task, unit, a.showSimulated);
    if (a.showSimulated) {
      row["simulated_fitness"] = task.simulatedFitness;
      row["rank"] = task.rank;
      if (task.disagreement) row["disagreement"] = *task.disagreement;
      row["candidates"] = task.candidates;
    }
    all.push_back(row);
    rows.push_back({std::to_string(task.stage), task.iteration > 0 ? std::to_string(task.iteration) : "",
                    std::to_string(task.position), std::to_string(task.individual),
                    std::to_string(valid) + "/" + std::to_string(task.wantedRepeats), text,
                    a.showSimulated ? brief(task.simulatedFitness) : "hidden", row["reason"].get<std::string>()});
  }
  if (shell.json)
    printJson(all);
  else if (rows.empty())
    std::cout << "run " << a.run << ": nothing waits for real fitness\n";
  else
    writeOut("", table({"stage", "L2", "order", "individual", "measured", "values [" + unit + "]", "simulated", "why"},
                       rows));
}

/// Refuses what is not possible, and without --yes what is doubtful. `places` says for each value where it came from.
void requirePlausible(const Database& db, const FitnessArguments& a, Shell& shell,
                      const std::vector<MeasurementRecord>& entered, const std::vector<std::string>& places) {
  const RunRecord run = db.run(a.run);
  const PreparedExperiment prepared = prepareFromRun(run, shell.plugins());
  const Fitness& fitness = *prepared.fitness;
  const KnownFitness known{db.measurementTasks(a.run), db.measurements(a.run), fitness.unit(), fitness.canBeNegative()};
  const std::string refusal = whyRefused(doubts(known, entered), a.yes, "with --yes it counts as it is", places);
  if (!refusal.empty()) throw InputError(refusal);
}

/// L3 has taken the value in already: a version of the simulator rests on it.
void warnOfAdapted(const Database& db, const MeasurementRecord& m) {
  if (const auto resting = simulatorRestingOn(db, m.run, m.individual))
    std::cerr << "btr: simulator version " << resting->number << " was adapted to this value (stage " << resting->stage
              << ") and stays as it is; to adapt again from the version before it: btr gap revert --db " << db.path()
              << " --run " << m.run << " --version " << resting->parent << "\n";
}

void enter(const FitnessArguments& a, Shell& shell) {
  if (a.values.empty() && !a.isVoid) throw CLI::ValidationError("enter", "give --value (once a repeat), or --void");
  Database db = Database::open(a.database, Database::Mode::readWrite);
  MeasurementRecord m;
  m.run = a.run;
  m.individual = a.individual;
  m.note = a.note;
  m.who = operatorName();
  m.isVoid = a.isVoid;
  m.enteredAt = utcNow();
  std::vector<MeasurementRecord> all;
  for (double value : a.values.empty() ? std::vector<double>{0} : a.values) {
    m.value = value;
    all.push_back(m);
  }
  requirePlausible(db, a, shell, all,
                   std::vector<std::string>(all.size(), "individual " + std::to_string(a.individual)));
  const std::vector<Id> stored = db.addMeasurements(all);
  keepInFile(db);
  if (shell.json) return printJson({{"individual", a.individual}, {"measurements", stored}});
  std::cout << "individual " << a.individual << ": " << all.size() << (all.size() == 1 ? " value" : " values")
            << " stored\n";
}

// Nothing measured is ever deleted: a value stops to count, or counts again.
void setVoid(const FitnessArguments& a, Shell& shell) {
  Database db = Database::open(a.database, Database::Mode::readWrite);
  MeasurementRecord m = db.measurement(a.measurement);
  if (m.run != a.run)
    throw InputError(db.path() + " run " + std::to_string(a.run), "measurement " + std::to_string(a.measurement),
                     "those of this run; it is of run " + std::to_string(m.run));
  const bool was = m.isVoid;
  db.setMeasurementVoid(m.id, a.isVoid, a.hasNote ? a.note : m.note);
  keepInFile(db);
  m = db.measurement(m.id);
  if (m.isVoid && !was) warnOfAdapted(db, m);
  if (shell.json)
    return printJson({{"measurement", m.id},
                      {"individual", m.individual},
                      {"value", m.value},
                      {"void", m.isVoid},
                      {"note", m.note}});
  std::cout << "measurement " << m.id << " of individual " << m.individual << ", " << brief(m.value)
            << (m.isVoid ? ": does not count\n" : ": counts\n");
}

void endRealityLearning(const FitnessArguments& a, Shell& shell) {
  Database::open(a.database, Database::Mode::readWrite).endRealityLearning(a.run, operatorName());
  if (shell.json) return printJson({{"run", a.run}, {"reality_learning", "ended"}});
  std::cout << "run " << a.run << ": L2 of this stage ends; what was measured is kept, btr run goes on with L3\n";
}

void import(const FitnessArguments& a, Shell& shell) {
  Database db = Database::open(a.database, Database::Mode::readWrite);
  db.run(a.run);  // an unknown run is named, not the individuals that it does not ask for
  const std::vector<MeasurementTask> tasks = db.measurementTasks(a.run);
  const std::string unit = prepareFromRun(db.run(a.run), shell.plugins()).fitness->unit();
  std::vector<std::string> places;
  std::vector<MeasurementRecord> all = readMeasuredCsv(a.file, &tasks, unit, &places);
  for (MeasurementRecord& m : all) {
    m.run = a.run;
    m.who = operatorName();
    m.enteredAt = utcNow();
  }
  for (std::string& place : places) place = a.file + " " + place;
  requirePlausible(db, a, shell, all, places);
  const std::vector<Id> stored = db.addMeasurements(all);
  keepInFile(db);
  if (shell.json) return printJson({{"file", a.file}, {"measurements", stored}});
  std::cout << a.file << ": " << all.size() << (all.size() == 1 ? " value" : " values") << " stored\n";
}

}  // namespace

void addFitnessCommands(CLI::App& app, Shell& shell) {
  CLI::App* fitness = app.add_subcommand("fitness", "real fitness: what waits for it, enter it, import it");
  fitness->require_subcommand(1);
  const auto common = [](CLI::App* command, FitnessArguments& a) {
    command->add_option("--db", a.database, "experiment database")->required();
    command->add_option("--run", a.run, "number of the run")->required()->transform(wholeNumber(1));
  };
  auto a = std::make_shared<FitnessArguments>();
  CLI::App* listCommand =
      fitness->add_subcommand("list", "individuals waiting for a real measurement, in the order to measure");
  common(listCommand, *a);
  listCommand->add_flag("--show-simulated", a->showSimulated, "also print the simulated fitness (not blind any more)");
  listCommand->callback([a, &shell] { list(*a, shell); });

  CLI::App* enterCommand = fitness->add_subcommand("enter", "store measured values of one individual");
  common(enterCommand, *a);
  enterCommand->add_option("--individual", a->individual, "number of the individual")
      ->required()
      ->transform(wholeNumber(1));
  enterCommand->add_option("--value", a->values, "measured fitness, once a repeat")
      ->take_all()
      ->transform(decimalNumber());
  enterCommand->add_option("--note", a->note, "surface, battery, what happened");
  enterCommand->add_flag("--void", a->isVoid, "does not count (the robot fell, the ball hit a wall)");
  enterCommand->add_flag("--yes", a->yes, "values far from what is expected are right: store them");
  enterCommand->callback([a, &shell] { enter(*a, shell); });

  CLI::App* importCommand =
      fitness->add_subcommand("import", "store a table of measured values: individual,value[,note][,void]");
  common(importCommand, *a);
  importCommand->add_option("MEASURED.csv", a->file, "the table")->required();
  importCommand->add_flag("--yes", a->yes, "values far from what is expected are right: store them");
  importCommand->callback([a, &shell] { import(*a, shell); });

  CLI::App* voidCommand = fitness->add_subcommand("void", "a stored value does not count, or with --undo counts again");
  common(voidCommand, *a);
  voidCommand->add_option("--measurement", a->measurement, "its number (fitness list --json, export)")
      ->required()
      ->transform(wholeNumber(1));
  CLI::Option* note = voidCommand->add_option("--note", a->note, "instead of its note");
  voidCommand->add_flag("--undo", a->counts, "it counts");
  voidCommand->callback([a, note, &shell] {
    a->isVoid = !a->counts;
    a->hasNote = note->count() > 0;
    setVoid(*a, shell);
  });

  CLI::App* end = app.add_subcommand("end-l2", "end learning in reality in the present stage before it is over");
  common(end, *a);
  end->callback([a, &shell] { endRealityLearning(*a, shell); });
}

}  // namespace btr::cli
