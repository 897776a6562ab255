#include "ui/controllers/compare_controller.h"

#include <map>

#include "core/spec/error.h"
#include "ui/charts/compare_page.h"

namespace btr::ui {

CompareController::CompareController(Workbench& bench, ComparePage& page)
    : QObject(&bench), bench_(bench), page_(page) {
  connect(&page_, &ComparePage::wanted, this, &CompareController::read);
  connect(&bench_.watcher(), &DatabaseWatcher::opened, &page_, &ComparePage::forget);
  connect(&bench_.watcher(), &DatabaseWatcher::runsChanged, this,
          [this](const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
            std::map<Id, QString> names;
            for (const ExperimentRecord& experiment : experiments)
              names[experiment.id] = QString::fromStdString(experiment.name);
            page_.setRuns(runs, names);
            if (page_.isVisible()) page_.readOn();
          });
  // What was measured, or is void now, changes stages of a run that stands still.
  connect(&bench_.watcher(), &DatabaseWatcher::tasksChanged, this, [this] {
    if (page_.isVisible()) page_.refresh();
  });
}

// What is damaged of one run hides no other.
void CompareController::read(const std::vector<Id>& runs) {
  struct Read {
    std::map<Id, ComparePage::History> histories;
    QString trouble;
  };
  bench_.reader().read(
      this, "histories", tr("the runs to compare"),
      [runs, host = bench_.host()](const Database& database) {
        Read read;
        for (const Id run : runs) {
          try {
            const ExperimentSpec spec =
                experimentFromJson(database.run(run).specJson, "run " + std::to_string(run), "");
            host->load(spec.plugins, "run " + std::to_string(run) + " /plugins");
            read.histories[run] = {database.generations(run), database.simulators(run), stageOutcomes(database, run),
                                   QString::fromStdString(host->fitness(spec.fitness.name)->unit())};
          } catch (const InputError& error) {
            read.trouble = QString::fromUtf8(error.what());
          }
        }
        return read;
      },
      [this](Read read) { page_.setHistories(std::move(read.histories), read.trouble); },
      [this](const QString& why) { page_.setHistories({}, why); });
}

void CompareController::compare(const std::vector<Id>& runs) {
  std::vector<Id> all = page_.chosen();
  all.insert(all.end(), runs.begin(), runs.end());
  page_.refresh();
  page_.setChosen(all);
  page_.showStages(true);
  emit bench_.dockWanted("compare");
}

}  // namespace btr::ui
