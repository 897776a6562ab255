// btr run, status, stop, stand-in.
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "app/cluster/btr_cluster.h"
#include "app/duration.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/loop/waiting.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/reality/stand_in.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/store/database.h"

namespace btr::cli {
namespace {

void showProgress(const RunProgress& p) {
  std::fprintf(stderr, "\r%-9s %d/%d  generation %d/%d  best %.4g  mean %.4g  %.0f trials/s  left %s \x1b[K",
               p.stage.c_str(), p.stageDone, p.stageTotal, p.generation, p.totalGenerations, p.best, p.mean,
               p.trialsPerSecond, p.secondsLeft < 0 ? "?" : duration(p.secondsLeft).c_str());
  std::fflush(stderr);
}

nlohmann::json orNull(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

/// "0.21 → 0.12", "" before the first update.
std::string change(const nlohmann::json& before, const nlohmann::json& after) {
  return before.is_null() || after.is_null() ? "" : brief(before) + " → " + brief(after);
}

nlohmann::json describe(const Database& db, const RunRecord& run) {
  nlohmann::json gaps = nlohmann::json::array();
  for (const GapRecord& g : db.gaps(run.id))
    gaps.push_back({{"stage", g.stage},
                    {"before", g.before},
                    {"after", g.after},
                    {"new_before", g.newBefore},
                    {"new_after", g.newAfter},
                    {"standard_error", g.standardError},
                    {"individuals", g.individuals},
                    {"held_out_before", orNull(g.heldOutBefore)},
                    {"held_out_after", orNull(g.heldOutAfter)},
                    {"held_out_standard_error", g.heldOutStandardError},
                    {"held_out_individuals", g.heldOutIndividuals}});
  const std::vector<RealityIteration> finished = db.realityIterations(run.id);
  int waiting = 0;
  const std::vector<MeasurementRecord> measured = db.measurements(run.id);
  for (const MeasurementTask& task : db.measurementTasks(run.id, run.stage + 1))
    waiting += !isOver(task, finished) && !isSettled(task, measured);
  return {{"run", run.id},
          {"experiment", db.experiment(run.experiment).name},
          {"seed", run.seed},
          {"state", toText(run.state)},
          {"reality", run.reality},
          {"generation", run.generation},
          {"stages_done", run.stage},
          {"simulators", db.simulators(run.id).size()},
          {"waiting_for_fitness", waiting},
          {"active", isRunActive(db.path(), run.id)},
          {"message", messageNow(db, run)},
          {"gaps", gaps}};
}

void printStatus(const Database& db, const std::vector<RunRecord>& runs, bool asJson) {
  nlohmann::json all = nlohmann::json::array();
  for (const RunRecord& run : runs) all.push_back(describe(db, run));
  if (asJson) {
    printJson(all);
    return;
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& r : all) {
    const bool standIn = r["reality"] == "stand_in";
    const bool isActive = r["active"].get<bool>();
    std::string state = r["state"].get<std::string>();
    // Of a run that no process works on: it was killed, or the machine was switched off.
    const bool isCutOff = !isActive && (state == toText(RunState::learning) || state == toText(RunState::adapting));
    state += isActive ? " (working)" : isCutOff ? " (interrupted)" : "";
    std::string gap, heldOut;
    if (!r["gaps"].empty()) {
      const auto& last = r["gaps"].back();
      gap = change(last["before"], last["after"]);
      heldOut = change(last["held_out_before"], last["held_out_after"]);
    }
    rows.push_back({std::to_string(r["run"].get<long>()), r["experiment"].get<std::string>(),
                    std::to_string(r["seed"].get<std::uint64_t>()), state, std::to_string(r["generation"].get<int>()),
                    std::to_string(r["stages_done"].get<int>()), std::to_string(r["simulators"].get<int>() - 1), gap,
                    heldOut, standIn ? "stand-in" : r["reality"].get<std::string>(), r["message"].get<std::string>()});
  }
  writeOut("", table({"run", "experiment", "seed", "state", "generation", "stages", "simulator", "gap", "held-out gap",
                      "reality", "message"},
                     rows));
}

struct RunArguments {
  std::string spec, database, places;
  Id run = 0;
  int jobs = 0;
  std::uint64_t seed = 0;
  bool seedGiven = false, again = false, quiet = false, withoutRecordings = false;
};

void run(const RunArguments& arguments, Shell& shell) {
  if (arguments.spec.empty() == (arguments.run == 0))
    throw CLI::ValidationError("run", "give either an experiment file or --run with the number of a stored run");
  ClusterJob cluster(shell, arguments.database, arguments.jobs);
  if (cluster.isDone()) return;
  cluster.tellTo(arguments.places);
  // Read before a database is made for it.
  const std::optional<ExperimentSpec> spec =
      arguments.run ? std::nullopt : std::optional(loadExperiment(arguments.spec));
  Database db =
      Database::open(arguments.database, spec ? Database::Mode::create : Database::Mode::readWrite, workingPatience_ms);
  Id id = arguments.run;
  if (spec) {
    std::string edited;
    id = startRun(db, shell.plugins(), *spec, arguments.seedGiven ? arguments.seed : spec->seed, arguments.again,
                  &edited);
    if (!edited.empty()) std::fprintf(stderr, "btr: %s: %s\n", arguments.spec.c_str(), edited.c_str());
  }
  for (const std::string& loss : runLosses(db.run(id), shell.plugins()))
    std::fprintf(stderr, "btr: note: %s\n", loss.c_str());
  shell.goesOn = true;
  RunOptions options;
  options.jobs = arguments.jobs;
  options.workforce = cluster.workforce();
  options.withoutRecordings = arguments.withoutRecordings;
  const bool show = isatty(STDERR_FILENO) && !arguments.quiet;
  options.progress = [&](const RunProgress& p) {
    if (show) showProgress(p);
    cluster.tellProgress(p.stage, p.totalGenerations ? static_cast<double>(p.generation) / p.totalGenerations : 0,
                         p.trialsPerSecond);
  };
  const RunEnd end = continueRun(db, shell.plugins(), id, *shell.stop, options);
  if (show) std::fprintf(stderr, "\n");
  if (!arguments.quiet) cluster.tell();
  printStatus(db, {db.run(id)}, shell.json);
  shell.exitCode = end == RunEnd::finished ? done : end == RunEnd::waiting ? waitsForFitness : stoppedEarly;
}

// Who asks is told what is wrong, in one place: by an answer.
void playRobot(const RunArguments& a, Shell& shell) try {
  const RunRecord record = Database::open(a.database, Database::Mode::readOnly).run(a.run);
  serveStandIn(asReality(prepareFromRun(record, shell.plugins()), record.seed), shell.plugins(), std::cin, std::cout);
} catch (const InputError& error) {
  const nlohmann::json answer{{"error", error.what()}};
  std::cout << answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  shell.exitCode = badInput;
}

}  // namespace

void addRunCommands(CLI::App& app, Shell& shell) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "start an experiment, or resume it if it is already in the database");
  command->add_option("SPEC", arguments->spec, "experiment file (.json)");
  command->add_option("--db", arguments->database, "experiment database")->required();
  command->add_option("--run", arguments->run, "resume this stored run instead of naming a file")
      ->transform(wholeNumber(1));
  command
      ->add_option("--jobs", arguments->jobs,
                   "worker processes (0: as many as processors); of each rank under mpirun or srun")
      ->transform(wholeNumber(0, 1024));
  CLI::Option* seed =
      command->add_option("--seed", arguments->seed, "instead of the seed in the file")->transform(seedNumber());
  command->add_flag("--again", arguments->again, "start a new run even if the same one is stored");
  command->add_flag("--without-recordings", arguments->withoutRecordings,
                    "go on with the recordings that are there, or without any");
  command->add_flag("--quiet", arguments->quiet, "no progress on stderr");
  addPlacesOption(command, arguments->places);
  command->callback([arguments, seed, &shell] {
    arguments->seedGiven = seed->count() > 0;
    run(*arguments, shell);
  });

  auto statusDb = std::make_shared<std::string>();
  CLI::App* status = app.add_subcommand("status", "runs, stage of each, what it waits for");
  status->add_option("--db", *statusDb, "experiment database")->required();
  status->callback([statusDb, &shell] {
    const Database db = Database::open(*statusDb, Database::Mode::readOnly);
    printStatus(db, db.runs(), shell.json);
  });

  auto stop = std::make_shared<RunArguments>();
  CLI::App* stopCommand = app.add_subcommand("stop", "ask a working run to stop; what it has done is kept");
  stopCommand->add_option("--db", stop->database, "experiment database")->required();
  stopCommand->add_option("--run", stop->run, "number of the run")->required()->transform(wholeNumber(1));
  stopCommand->callback([stop, &shell] {
    Database::open(stop->database, Database::Mode::readWrite).requestStop(stop->run, true);
    if (shell.json) printJson({{"run", stop->run}, {"stop_requested", true}});
  });

  auto standIn = std::make_shared<RunArguments>();
  CLI::App* standInCommand = app.add_subcommand(
      "stand-in", "play the real robot of a run: JSON requests on standard input, answers on standard output");
  standInCommand->add_option("--db", standIn->database, "experiment database")->required();
  standInCommand->add_option("--run", standIn->run, "number of the run")->required()->transform(wholeNumber(1));
  standInCommand->callback([standIn, &shell] { playRobot(*standIn, shell); });
}

}  // namespace btr::cli
