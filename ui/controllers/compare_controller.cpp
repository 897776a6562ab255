#include "ui/controllers/compare_controller.h"

#include <map>

#include "ui/charts/compare_page.h"

namespace btr::ui {

CompareController::CompareController(Workbench& bench, ComparePage& page)
    : QObject(&bench), bench_(bench), page_(page) {
  page_.setReader([this](Id run) {
    const Database& database = bench_.watcher().database();
    const ExperimentSpec spec = experimentFromJson(database.run(run).specJson, "run " + std::to_string(run), "");
    return ComparePage::History{database.generations(run), database.simulators(run), stageOutcomes(database, run),
                                QString::fromStdString(bench_.host()->fitness(spec.fitness.name)->unit())};
  });
  connect(&bench_.watcher(), &DatabaseWatcher::runsChanged, this,
          [this](const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
            std::map<Id, QString> names;
            for (const ExperimentRecord& experiment : experiments)
              names[experiment.id] = QString::fromStdString(experiment.name);
            page_.setRuns(runs, names);
            if (page_.isVisible()) page_.refresh();
          });
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
