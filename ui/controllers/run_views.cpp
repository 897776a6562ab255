#include "ui/controllers/run_views.h"

#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/run_panel.h"
#include "ui/experiment/run_text.h"
#include "ui/experiment/simulators_page.h"

namespace btr::ui {
namespace {

constexpr std::size_t rowsAPage = 250;

/// Whole generations, so that the window takes in a bounded number of rows at once.
IndividualsTable::Page pageOf(const Database& database, Id run, int first, int last) {
  IndividualsTable::Page page;
  for (page.next = first; page.next <= last && page.individuals.size() < rowsAPage; ++page.next) {
    std::vector<IndividualRecord> generation = database.individuals(run, page.next);
    page.individuals.insert(page.individuals.end(), std::make_move_iterator(generation.begin()),
                            std::make_move_iterator(generation.end()));
  }
  return page;
}

}  // namespace

RunViews::RunViews(Workbench& bench, const Pages& pages) : QObject(&bench), bench_(bench), pages_(pages) {
  DatabaseWatcher& watcher = bench_.watcher();
  connect(&bench_, &Workbench::runSelected, this, &RunViews::select);
  connect(&watcher, &DatabaseWatcher::runChanged, &pages_.panel, &RunPanel::showRun);
  connect(&watcher, &DatabaseWatcher::generationsReset, this, [this](Id run, const std::vector<GenerationRecord>& all) {
    pages_.fitness.setGenerations(all);
    pages_.panel.setGenerations(all);
    pages_.individuals.load(
        all.empty() ? 0 : all.back().number,
        [this, run](int first, int last, IndividualsTable::Take take, IndividualsTable::Failed failed) {
          bench_.reader().read(
              &pages_.individuals, "individuals", tr("the individuals"),
              [run, first, last](const Database& database) { return pageOf(database, run, first, last); },
              std::move(take), std::move(failed));
        });
  });
  connect(&watcher, &DatabaseWatcher::generationsAdded, this, [this](Id, const std::vector<GenerationRecord>& added) {
    pages_.panel.addGenerations(added);
    pages_.fitness.append(added);
    pages_.individuals.extend(added.back().number);
  });
  connect(&watcher, &DatabaseWatcher::simulatorsChanged, this,
          [this](Id, const std::vector<SimulatorRecord>& simulators) {
            simulators_ = simulators;
            pages_.fitness.setSimulators(simulators_);
            pages_.gap.setGaps(gaps_, simulators_);
            pages_.versions.setSimulators(simulators_);
            pages_.individuals.setSimulators(simulators_);
          });
  connect(&watcher, &DatabaseWatcher::gapsChanged, this, [this](Id, const std::vector<GapRecord>& gaps) {
    gaps_ = gaps;
    pages_.gap.setGaps(gaps_, simulators_);
    pages_.versions.setGaps(gaps_);
  });
  connect(&watcher, &DatabaseWatcher::tasksChanged, this,
          [this](Id, const auto&, const std::vector<MeasurementRecord>& measurements) {
            pages_.individuals.setMeasurements(measurements);
          });
}

void RunViews::clear() {
  pages_.panel.clear();
  pages_.fitness.setRun({});
  pages_.fitness.setUnit({});
  pages_.gap.setGaps({}, {});
  pages_.gap.setUnit({});
  pages_.versions.clear();
  pages_.individuals.clear();
}

// What is fixed for a run: its settings, the unit of its fitness, its label.
void RunViews::select(const RunRecord& run) {
  gaps_.clear();
  simulators_.clear();
  if (run.id == 0) return clear();
  const bool standIn = isStandIn(run);
  FitnessRun shown;
  shown.run = run.id;
  shown.name = runName(run);
  shown.standIn = standIn;
  pages_.fitness.setRun(shown);
  pages_.gap.setStandIn(standIn);
  ExperimentSpec spec = experimentFromJson(run.specJson, "run " + std::to_string(run.id), "");
  // Runs of one experiment share its specification; each has a seed of its own.
  spec.seed = run.seed;
  if (!spec.plugins.empty()) pages_.spec.setOffers(offersOf(*bench_.host()));
  pages_.spec.setSpec(spec);
  try {
    pages_.spec.setMeaningful(parametersOfRun(run));
  } catch (const InputError&) {
    // A robot's file that cannot be read is said by whoever plays the run again; all are shown.
    pages_.spec.setMeaningful(simulatorParameters());
  }
  const QString unit = QString::fromStdString(bench_.host()->fitness(spec.fitness.name)->unit());
  pages_.panel.setUnit(unit);
  pages_.fitness.setUnit(unit);
  pages_.gap.setUnit(unit);
  pages_.gap.setNorm(
      static_cast<GapNorm>(static_cast<int>(valueOf(adaptationParameters(), spec.adaptationSettings, "norm"))));
  pages_.versions.setUnit(unit);
  pages_.individuals.setUnit(unit);
  pages_.individuals.setStandIn(standIn);
  pages_.individuals.setGenotype(bench_.host()->controller(spec.controller.name)->genotype());
}

}  // namespace btr::ui
