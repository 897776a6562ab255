// The lineage of simulators: what changed against the parent is bold.
#include <QLabel>
#include <QTableWidget>
#include <QTest>

#include "tests/ui/ui_tests.h"
#include "ui/experiment/simulators_page.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// Of a run of a robot for which all parameters mean something.
std::vector<SimulatorRecord> twoVersions() {
  SimulatorRecord first, second;
  first.id = 11;
  first.madeBy = "start";
  second.id = 12;
  second.number = 1;
  second.parent = 11;
  second.madeBy = "L3";
  second.madeAfterGeneration = 50;
  for (const Parameter& p : simulatorParameters()) first.simulator.values[p.name] = p.byDefault;
  second.simulator = first.simulator;
  second.simulator.values["friction"] = 0.5;
  return {first, second};
}

int rowOf(const QTableWidget& table, const QString& name) {
  for (int row = 0; row < table.rowCount(); ++row)
    if (table.item(row, 0)->toolTip() == name) return row;
  return -1;
}

}  // namespace

class TestSimulatorsPage : public QObject {
  Q_OBJECT
 private slots:
  void choosesTheNewestVersionAndMarksWhatChanged() {
    SimulatorsPage page;
    page.setSimulators(twoVersions());
    auto* versions = page.findChild<QTableWidget*>("versions");
    auto* difference = page.findChild<QTableWidget*>("difference");
    QCOMPARE(versions->rowCount(), 2);
    QCOMPARE(versions->currentRow(), 1);
    QCOMPARE(versions->item(1, 0)->text(), QString("1  ← 0"));
    QCOMPARE(difference->rowCount(), int(simulatorParameters().size()));

    const double before = valueOf(simulatorParameters(), {}, "friction");
    const int friction = rowOf(*difference, "friction");
    QVERIFY(difference->item(friction, 0)->font().bold());
    QCOMPARE(difference->item(friction, 1)->text().toDouble(), before);
    QCOMPARE(difference->item(friction, 2)->text().toDouble(), 0.5);
    const QString percent = QString::number(qAbs(0.5 / before - 1) * 100, 'f', 1) + " %";
    QCOMPARE(difference->item(friction, 3)->text(), (0.5 > before ? "+" : "−") + percent);
    QVERIFY(!difference->item(rowOf(*difference, "leg_mass_kg"), 0)->font().bold());
    QVERIFY(page.findChild<QLabel*>("title")->text().contains("1"));
  }

  void theFirstVersionHasNothingToCompareWith() {
    SimulatorsPage page;
    page.setSimulators(twoVersions());
    page.select(11);
    auto* difference = page.findChild<QTableWidget*>("difference");
    for (int row = 0; row < difference->rowCount(); ++row) {
      QVERIFY(!difference->item(row, 0)->font().bold());
      QCOMPARE(difference->item(row, 1)->text(), QString());
    }
  }

  void aNewVersionIsShownUnlessAnOlderOneWasChosen() {
    SimulatorsPage page;
    auto simulators = twoVersions();
    page.setSimulators(simulators);
    SimulatorRecord third = simulators.back();
    third.id = 13;
    third.number = 2;
    third.parent = 12;
    simulators.push_back(third);
    page.setSimulators(simulators);
    QCOMPARE(page.findChild<QTableWidget*>("versions")->currentRow(), 2);
    page.select(11);
    page.setSimulators(simulators);
    QCOMPARE(page.findChild<QTableWidget*>("versions")->currentRow(), 0);
  }

  void showsTheGapBeforeAndAfterAnUpdateWithItsUnit() {
    SimulatorsPage page;
    page.setUnit("m");
    page.setSimulators(twoVersions());
    GapRecord gap;
    gap.simulatorBefore = 11;
    gap.simulatorAfter = 12;
    gap.before = 0.25;
    gap.after = 0.125;
    page.setGaps({gap});
    auto* versions = page.findChild<QTableWidget*>("versions");
    QCOMPARE(versions->item(1, 3)->text().replace(QChar(0x202f), ' '), QString("0.25 m"));
    QCOMPARE(versions->item(1, 4)->text().replace(QChar(0x202f), ' '), QString("0.125 m"));
    QCOMPARE(versions->item(0, 3)->text(), QString());
  }

  void namesAddedEffectsAndPathsOfTheScene() {
    SimulatorsPage page;
    auto simulators = twoVersions();
    simulators[1].simulator.values["robots.dog.links.head.mass_kg"] = 0.3;
    simulators[1].simulator.effects = {{"backlash", "dog.LF_J1", {{"width_rad", 0.05}}}};
    page.setSimulators(simulators);
    QVERIFY(rowOf(*page.findChild<QTableWidget*>("difference"), "robots.dog.links.head.mass_kg") >= 0);
    QVERIFY(page.findChild<QLabel*>("effects")->text().contains("<b>backlash at dog.LF_J1 (width_rad = 0.05)</b>"));
  }

  // An arm has neither an AIBO's legs nor its head.
  void aRobotOfOnesOwnHasTheNumbersThatItsVersionsHave() {
    auto simulators = twoVersions();
    for (SimulatorRecord& version : simulators)
      std::erase_if(version.simulator.values, [](const auto& value) { return value.first.ends_with("_kg"); });
    SimulatorsPage page;
    page.setSimulators(simulators);
    auto* difference = page.findChild<QTableWidget*>("difference");
    QVERIFY(rowOf(*difference, "friction") >= 0);
    QCOMPARE(rowOf(*difference, "head_mass_kg"), -1);
    page.findChild<QTableWidget*>("versions")->setCurrentCell(0, 0);
    QCOMPARE(rowOf(*difference, "head_mass_kg"), -1);
  }

  // A rig has none of a run's twelve parameters: what a version does not name is the scene's own.
  void ofARigItShowsWhatItsVersionsName() {
    auto simulators = twoVersions();
    for (SimulatorRecord& version : simulators) version.rig = 5, version.simulator = {};
    simulators[1].simulator.values = {{"robots.arm.servos.elbow.p", 3.5}};
    SimulatorRecord back = simulators[1];
    back.id = 13;
    back.number = 2;
    back.parent = 12;
    back.simulator = {};
    simulators.push_back(back);
    SimulatorsPage page;
    page.setSimulators(simulators);
    auto* versions = page.findChild<QTableWidget*>("versions");
    auto* difference = page.findChild<QTableWidget*>("difference");
    versions->setCurrentCell(1, 0);
    QCOMPARE(difference->rowCount(), 1);
    QCOMPARE(difference->item(0, 1)->text(), QString("as given"));
    QCOMPARE(difference->item(0, 2)->text(), QString("3.5"));
    QCOMPARE(difference->item(0, 3)->text(), QString("new"));
    versions->setCurrentCell(2, 0);
    QCOMPARE(difference->item(0, 1)->text(), QString("3.5"));
    QCOMPARE(difference->item(0, 2)->text(), QString("as given"));
    QCOMPARE(difference->item(0, 3)->text(), QString("taken back"));
    versions->setCurrentCell(0, 0);
    QCOMPARE(page.findChild<QLabel*>("title")->text(), QString("Simulator 0: the scene as given"));
  }
};

UI_TEST(TestSimulatorsPage)
#include "test_simulators_page.moc"
