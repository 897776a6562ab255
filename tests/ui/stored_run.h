#pragma once
#include <QDir>
#include <QTemporaryDir>

#include "core/run/loop/back_to_reality.h"
#include "core/spec/experiment_spec.h"
#include "core/store/database.h"

// A small database made through btr::Database: one experiment with runs of two individuals a generation.
namespace btr::ui {

class StoredRun {
 public:
  StoredRun() : database(Database::open(path(), Database::Mode::create)) {}
  std::string path() const { return folder.filePath("test.db").toStdString(); }
  QString qpath() const { return QString::fromStdString(path()); }

  static ExperimentSpec spec() {
    ExperimentSpec spec;
    spec.name = "Kick";
    spec.scene = "../scenes/kick.json";
    spec.controller.name = "kick";
    spec.fitness.name = "kick_distance";
    spec.learner.name = spec.adaptation.name = "ga";
    spec.stages = {{"first_generations", 3}, {"total_generations", 6}, {"measured_individuals", 2}};
    return spec;
  }

  Id addExperiment(const std::string& name = "Kick") {
    return database.addExperiment({.name = name, .specJson = toJsonText(spec()), .createdAt = "", .note = ""});
  }

  Id addRun(Id experiment, std::uint64_t seed = 1, const std::string& reality = "person") {
    RunRecord run;
    run.experiment = experiment;
    run.seed = seed;
    run.specJson = toJsonText(spec());
    run.specSha256 = sha256(run.specJson);
    run.sceneJson = R"({"format": "uchilsim-scene-1"})";
    run.reality = reality;
    SimulatorRecord first;
    first.madeBy = "start";
    return database.addRun(run, first);
  }

  void addGenerations(Id run, int count) {
    const Id simulator = database.simulators(run).back().id;
    const int done = database.run(run).generation;
    for (int number = done + 1; number <= done + count; ++number) {
      GenerationRecord generation;
      generation.run = run;
      generation.number = number;
      generation.simulator = simulator;
      generation.best = 0.1 * number + 1.0 / 3;
      generation.mean = 0.05 * number;
      generation.worst = 0.01;
      generation.trials = 2;
      generation.randomState = generation.learnerState = "{}";
      for (int slot = 0; slot < 2; ++slot) {
        IndividualRecord individual;
        individual.generation = number;
        individual.slot = slot;
        individual.simulator = simulator;
        individual.chromosome = QByteArray::number(number * 2 + slot, 2).toStdString();
        individual.parameters.assign(25, 0.5);
        individual.fitness = slot == 0 ? generation.best : generation.worst;
        generation.individuals.push_back(individual);
      }
      database.addGeneration(generation);
    }
  }

  // The best of the generations so far wait to be measured.
  std::vector<MeasurementTask> addTasks(Id run) {
    std::vector<MeasurementTask> tasks;
    for (const auto& individual : database.bestIndividuals(run, 2, 1, 0)) {
      MeasurementTask task;
      task.run = run;
      task.stage = database.run(run).stage + 1;
      task.individual = individual.id;
      task.position = int(tasks.size()) + 1;
      task.simulatedFitness = individual.fitness;
      tasks.push_back(task);
    }
    database.addMeasurementStage(run, tasks.front().stage, tasks);
    return tasks;
  }

  // A run of three generations whose first measurement stage waits.
  Id addWaitingRun(Id experiment, std::uint64_t seed = 1, const std::string& reality = "person") {
    const Id run = addRun(experiment, seed, reality);
    addGenerations(run, 3);
    addTasks(run);
    return run;
  }

  Id measure(Id run, Id individual, double value) {
    MeasurementRecord measurement;
    measurement.run = run;
    measurement.individual = individual;
    measurement.value = value;
    return database.addMeasurement(measurement);
  }

  Id finishStage(Id run, const Values& values) {
    const SimulatorRecord parent = database.simulators(run).back();
    SimulatorRecord next;
    next.run = run;
    next.number = parent.number + 1;
    next.parent = parent.id;
    next.simulator.values = values;
    next.madeBy = "L3";
    next.madeAfterGeneration = database.run(run).generation;
    GapRecord gap;
    gap.run = run;
    gap.stage = database.run(run).stage + 1;
    gap.simulatorBefore = parent.id;
    gap.before = 0.4;
    gap.after = 0.1;
    gap.newBefore = 0.4;
    gap.newAfter = 0.1;
    gap.individuals = 2;
    return database.finishStage(next, gap, RunState::learning);
  }

  QTemporaryDir folder;
  Database database;
};

}  // namespace btr::ui
