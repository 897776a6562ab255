// The tree of experiments, runs and simulator versions, from a stored database.
#include <QAbstractItemModelTester>
#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QTreeView>

#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/experiment/badge_delegate.h"
#include "ui/experiment/experiment_tree.h"

using namespace btr;
using namespace btr::ui;

namespace {

void fill(ExperimentTree& tree, StoredRun& stored) {
  tree.setContent(stored.database.experiments(), stored.database.runs());
  for (const auto& run : stored.database.runs()) tree.setSimulators(run.id, stored.database.simulators(run.id));
}

QAction* entry(QMenu& menu, const QString& text) {
  for (QAction* action : menu.actions())
    if (action->text().startsWith(text)) return action;
  return nullptr;
}

}  // namespace

class TestExperimentTree : public QObject {
  Q_OBJECT
 private slots:
  void showsExperimentsRunsAndVersionsFromTheDatabase() {
    StoredRun stored;
    const Id experiment = stored.addExperiment("Kick");
    const Id run = stored.addWaitingRun(experiment, 7, "stand_in");
    stored.finishStage(run, {{"friction", 0.5}});
    ExperimentTree tree;
    fill(tree, stored);

    QAbstractItemModel& model = *tree.view()->model();
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
    QCOMPARE(model.rowCount(), 1);
    const QModelIndex kick = model.index(0, 0);
    QCOMPARE(kick.data().toString(), QString("Kick"));
    const QModelIndex first = model.index(0, 0, kick);
    QCOMPARE(first.data().toString(), QString("Run %1 · seed 7").arg(run));
    QCOMPARE(first.data(BadgeDelegate::BadgeRole).toString(), QString("stand-in"));
    QCOMPARE(first.siblingAtColumn(1).data().toString(), QString("3"));
    QCOMPARE(model.rowCount(first), 2);
    QCOMPARE(model.index(1, 0, first).data().toString(), QString("Simulator 1"));
    QCOMPARE(model.index(1, 2, first).data().toString(), QString("L3"));
  }

  // A narrow pane: the badge leaves the run's name its place and stands below, beside the detail.
  void theBadgeNeverHidesTheName() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment("Kick"), 7, "stand_in");
    ExperimentTree tree;
    fill(tree, stored);
    const QModelIndex shown = tree.view()->model()->index(0, 0, tree.view()->model()->index(0, 0));
    QStyleOptionViewItem option;
    option.font = tree.font();
    option.decorationSize = {18, 18};
    const int name = QFontMetrics(option.font).horizontalAdvance(shown.data().toString());
    const int badge = QFontMetrics(option.font).horizontalAdvance("stand-in");
    for (const int width : {name + 36, name + 40 + badge / 2, name + 2 * badge + 60}) {
      option.rect = QRect(10, 20, width, 40);
      const auto places = BadgeDelegate::placesOf(option, shown);
      QCOMPARE(places.text, QString("Run %1 · seed 7").arg(run));
      QVERIFY(option.rect.contains(places.badgeAt));
      QRect text = places.textAt, detail = places.detailAt;
      text.setWidth(name);
      QVERIFY(!text.intersects(places.badgeAt) && !detail.intersects(places.badgeAt));
    }
  }

  void showsARigsVersionsBelowItself() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment("Kick"));
    const Id rig = stored.database.addRig({0, "xl330", "{}", "", ""}, SimulatorRecord{});
    SimulatorRecord version;
    version.rig = rig;
    version.number = 1;
    version.parent = stored.database.rigSimulators(rig).front().id;
    version.madeBy = "gap analysis";
    const Id adopted = stored.database.addRigSimulator(version);
    ExperimentTree tree;
    fill(tree, stored);
    tree.setRigs(stored.database.rigSimulators(0));
    fill(tree, stored);  // again, as after every change of the database
    QAbstractItemModel& model = *tree.view()->model();
    QCOMPARE(model.rowCount(), 2);
    const QModelIndex shown = model.index(1, 0);
    QCOMPARE(shown.data().toString(), QString("xl330"));
    QCOMPARE(shown.data(BadgeDelegate::DetailRole).toString(), QString("rig · simulator version 1"));
    QCOMPARE(model.rowCount(shown), 2);
    QCOMPARE(model.index(1, 0, shown).data(BadgeDelegate::DetailRole).toString(), QString("gap analysis"));

    QSignalSpy rigs(&tree, &ExperimentTree::rigSelected), runs(&tree, &ExperimentTree::runSelected);
    tree.view()->setCurrentIndex(model.index(1, 0, shown));
    QCOMPARE(rigs.size(), 1);
    QCOMPARE(rigs.first().at(0).toLongLong(), rig);
    QCOMPARE(rigs.first().at(1).toLongLong(), adopted);
    QCOMPARE(tree.selectedRun(), Id(0));
    tree.view()->setCurrentIndex(shown);
    QCOMPARE(rigs.last().at(1).toLongLong(), Id(0));
    QCOMPARE(runs.size(), 0);
    tree.selectRun(run);
    QCOMPARE(tree.selectedRun(), run);
    QCOMPARE(tree.selectedRig(), Id(0));
  }

  void putsTheRunsOfAGridsCellsTogether() {
    StoredRun stored;
    const Id experiment = stored.addExperiment();
    const Id alone = stored.addRun(experiment, 1), first = stored.addRun(experiment, 2),
             second = stored.addRun(experiment, 3);
    const auto fillWith = [&](ExperimentTree& tree, const std::vector<RunGroup>& groups) {
      tree.setContent(stored.database.experiments(), stored.database.runs(), groups);
    };
    ExperimentTree tree;
    QAbstractItemModel& model = *tree.view()->model();
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
    fillWith(tree, {});
    const QModelIndex kick = model.index(0, 0);
    QCOMPARE(model.rowCount(kick), 3);
    // The grid has the number of a run: they are not taken for each other.
    const std::vector<RunGroup> groups{{alone, "The whole kick", {{first, 1}, {second, 2}}}};
    for (int time = 0; time < 2; ++time) {
      fillWith(tree, groups);
      QCOMPARE(model.rowCount(kick), 2);
      QModelIndex group = model.index(0, 0, kick), single = model.index(1, 0, kick);
      if (model.rowCount(group) == 0) std::swap(group, single);
      QCOMPARE(group.data().toString(), QString("The whole kick"));
      QCOMPARE(single.data().toString(), QString("Run %1 · seed 1").arg(alone));
      QCOMPARE(model.rowCount(group), 2);
      QCOMPARE(model.index(1, 0, group).data().toString(), QString("Cell 2 · Run %1 · seed 3").arg(second));
      tree.selectRun(second);
      QCOMPARE(tree.selectedRun(), second);
      QVERIFY(tree.view()->isExpanded(group));
      QSignalSpy asked(&tree, &ExperimentTree::gridRequested);
      emit tree.view()->activated(group);
      QCOMPARE(asked.count(), 1);
      QCOMPARE(asked[0][0].value<Id>(), alone);
    }
    fillWith(tree, {});
    QCOMPARE(model.rowCount(kick), 3);
  }

  void keepsTheSelectionWhenRunsAreAdded() {
    StoredRun stored;
    const Id experiment = stored.addExperiment();
    const Id run = stored.addRun(experiment, 1);
    ExperimentTree tree;
    fill(tree, stored);
    tree.selectRun(run);
    QSignalSpy selected(&tree, &ExperimentTree::runSelected);
    stored.addRun(experiment, 2);
    stored.addExperiment("Other");
    fill(tree, stored);
    QCOMPARE(tree.selectedRun(), run);
    QCOMPARE(selected.count(), 0);
    QCOMPARE(tree.view()->model()->rowCount(), 2);
  }

  void tellsTheRunThatIsChosenByKeyboard() {
    StoredRun stored;
    const Id experiment = stored.addExperiment();
    const Id run = stored.addRun(experiment);
    ExperimentTree tree;
    fill(tree, stored);
    QSignalSpy selected(&tree, &ExperimentTree::runSelected), note(&tree, &ExperimentTree::runNoteRequested);
    tree.view()->setCurrentIndex(tree.view()->model()->index(0, 0));
    QTest::keyClick(tree.view(), Qt::Key_Down);
    QCOMPARE(selected.count(), 1);
    QCOMPARE(selected.first().first().value<Id>(), run);
    emit tree.view()->actions().first()->triggered();  // F2
    QCOMPARE(note.count(), 1);
  }

  void offersWhatFitsTheState() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    ExperimentTree tree;
    fill(tree, stored);
    {
      QMenu menu;
      tree.fillRunMenu(menu, run);
      QVERIFY(entry(menu, "Start")->isEnabled());
      QVERIFY(!entry(menu, "Stop")->isEnabled());
    }
    tree.setActive({run});
    {
      QMenu menu;
      tree.fillRunMenu(menu, run);
      QVERIFY(!entry(menu, "Continue")->isEnabled());
      QVERIFY(entry(menu, "Stop")->isEnabled());
      QSignalSpy stop(&tree, &ExperimentTree::stopRequested);
      entry(menu, "Stop")->trigger();
      QCOMPARE(stop.first().first().value<Id>(), run);
    }
    tree.setActive({});
    stored.database.setRunState(run, RunState::finished, "");
    fill(tree, stored);
    QMenu menu;
    tree.fillRunMenu(menu, run);
    QVERIFY(!entry(menu, "Continue")->isEnabled());
    QVERIFY(entry(menu, "Duplicate with another seed")->isEnabled());
    QSignalSpy compare(&tree, &ExperimentTree::compareRequested);
    entry(menu, "Compare")->trigger();
    QCOMPARE(compare.first().first().value<std::vector<Id>>(), std::vector<Id>{run});
    QSignalSpy table(&tree, &ExperimentTree::exportRequested);
    entry(menu, "Export as CSV")->menu()->actions().first()->trigger();
    QCOMPARE(table.first().last().toString(), QString("generations"));
  }

  void experimentsOfOneNameAreToldApart() {
    StoredRun stored;
    const Id first = stored.addExperiment("Kick");
    stored.addExperiment("Kick");
    stored.addExperiment("Walk");
    ExperimentTree tree;
    fill(tree, stored);
    QAbstractItemModel& model = *tree.view()->model();
    const auto detail = [&](int row) { return model.index(row, 0).data(BadgeDelegate::DetailRole).toString(); };
    QVERIFY(detail(0).startsWith(QString("number %1, stored 2").arg(first)));
    QVERIFY(detail(0) != detail(1));
    QCOMPARE(detail(2), QString());
  }

  void searchShowsWhatHasTheTextAndWhatIsAboveAndBelow() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment("Kick"), 7);
    stored.addRun(stored.addExperiment("Walk"), 8);
    stored.database.setRunNote(run, "worn knee");
    ExperimentTree tree;
    fill(tree, stored);
    auto* search = tree.findChild<QLineEdit*>("searchExperiments");
    const auto hidden = [&](int row) { return tree.view()->isRowHidden(row, {}); };
    QTest::keyClicks(search, "WORN");
    QVERIFY(!hidden(0) && hidden(1));
    QVERIFY(!tree.view()->isRowHidden(0, tree.view()->model()->index(0, 0)));
    search->setText("walk");
    QVERIFY(hidden(0) && !hidden(1));
    QVERIFY(!tree.view()->isRowHidden(0, tree.view()->model()->index(1, 0)));
    // What comes along meanwhile is judged by the same text.
    stored.addExperiment("Swing");
    fill(tree, stored);
    QVERIFY(hidden(2));
    search->clear();
    QVERIFY(!hidden(0) && !hidden(1) && !hidden(2));
  }

  void sortsByNameOrAgeAndKeepsTheSelection() {
    StoredRun stored;
    stored.addExperiment("Walk");
    const Id run = stored.addRun(stored.addExperiment("kick"));
    stored.addExperiment("Swing");
    ExperimentTree tree;
    fill(tree, stored);
    tree.selectRun(run);
    auto* order = tree.findChild<QComboBox*>("orderExperiments");
    const auto names = [&] {
      QStringList all;
      for (int row = 0; row < 3; ++row) all << tree.view()->model()->index(row, 0).data().toString();
      return all;
    };
    QCOMPARE(names(), QStringList({"Walk", "kick", "Swing"}));
    order->setCurrentIndex(1);
    QCOMPARE(names(), QStringList({"Swing", "kick", "Walk"}));
    order->setCurrentIndex(2);
    QCOMPARE(names(), QStringList({"kick", "Swing", "Walk"}));
    QCOMPARE(tree.selectedRun(), run);
    order->setCurrentIndex(0);
    QCOMPARE(names(), QStringList({"Walk", "kick", "Swing"}));
  }

  void archivedExperimentsAreHiddenUntilTheArchiveIsShown() {
    StoredRun stored;
    const Id kick = stored.addExperiment("Kick");
    stored.addExperiment("Walk");
    ExperimentTree tree;
    fill(tree, stored);
    QSignalSpy archived(&tree, &ExperimentTree::archivedChanged), renamed(&tree, &ExperimentTree::renameRequested);
    tree.view()->setCurrentIndex(tree.view()->model()->index(0, 0));
    QMenu menu;
    tree.fillMenu(menu);
    entry(menu, "Rename")->trigger();
    QCOMPARE(renamed.first().first().value<Id>(), kick);
    entry(menu, "Archive")->trigger();
    QCOMPARE(archived.first().first().value<std::set<Id>>(), std::set<Id>{kick});
    QVERIFY(tree.view()->isRowHidden(0, {}));
    tree.findChild<QToolButton*>("showArchive")->click();
    QVERIFY(!tree.view()->isRowHidden(0, {}));
    QMenu again;
    tree.fillMenu(again);
    entry(again, "Take out of the archive")->trigger();
    tree.findChild<QToolButton*>("showArchive")->click();
    QVERIFY(!tree.view()->isRowHidden(0, {}));
  }

  void severalSelectedRunsAreComparedAndStoppedTogether() {
    StoredRun stored;
    const Id experiment = stored.addExperiment();
    const Id first = stored.addRun(experiment, 1), second = stored.addRun(experiment, 2);
    stored.addRun(experiment, 3);
    ExperimentTree tree;
    fill(tree, stored);
    tree.setActive({first, second});
    const QModelIndex kick = tree.view()->model()->index(0, 0);
    auto* selection = tree.view()->selectionModel();
    for (const int row : {0, 1})
      selection->select(tree.view()->model()->index(row, 0, kick),
                        QItemSelectionModel::Select | QItemSelectionModel::Rows);
    QMenu menu;
    tree.fillMenu(menu);
    QSignalSpy compare(&tree, &ExperimentTree::compareRequested), stop(&tree, &ExperimentTree::stopRequested);
    entry(menu, "Compare these 2 runs")->trigger();
    QCOMPARE(compare.first().first().value<std::vector<Id>>(), (std::vector<Id>{first, second}));
    QVERIFY(!entry(menu, "Continue them")->isEnabled());
    entry(menu, "Stop them")->trigger();
    QCOMPARE(stop.count(), 2);
  }
};

UI_TEST(TestExperimentTree)
#include "test_experiment_tree.moc"
