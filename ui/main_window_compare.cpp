// Runs side by side in the window: the page is read from the database that is open.
#include <QDockWidget>
#include <QScreen>
#include <algorithm>

#include "ui/charts/compare_page.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/main_window.h"

namespace btr::ui {

void MainWindow::makeComparePage() {
  comparePage_ = new ComparePage(this);
  layout_.add("compare", tr("Compare runs"), "office-chart-line", comparePage_);
}

void MainWindow::connectCompare() {
  comparePage_->setReader([this](Id run) {
    const Database& database = watcher_.database();
    const ExperimentSpec spec = experimentFromJson(database.run(run).specJson, "run " + std::to_string(run), "");
    return ComparePage::History{database.generations(run), database.simulators(run), stageOutcomes(database, run),
                                QString::fromStdString(host_->fitness(spec.fitness.name)->unit())};
  });
  connect(&watcher_, &DatabaseWatcher::runsChanged, this,
          [this](const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
            std::map<Id, QString> names;
            for (const ExperimentRecord& experiment : experiments)
              names[experiment.id] = QString::fromStdString(experiment.name);
            comparePage_->setRuns(runs, names);
            if (comparePage_->isVisible()) comparePage_->refresh();
          });
  connect(tree_, &ExperimentTree::compareRequested, this, &MainWindow::compareRuns);
}

void MainWindow::compareRuns(const std::vector<Id>& runs) {
  std::vector<Id> all = comparePage_->chosen();
  all.insert(all.end(), runs.begin(), runs.end());
  comparePage_->refresh();
  comparePage_->setChosen(all);
  comparePage_->showStages(true);
  // A wide page: it stands in a window of its own size until the user docks it.
  layout_.dock("compare")->setFloating(true);
  layout_.dock("compare")->resize(QSize(1200, 800).boundedTo(screen()->availableSize()));
  layout_.raise("compare");
}

}  // namespace btr::ui
