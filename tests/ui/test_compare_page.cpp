// Comparing runs: what differs between their specs, and their fitness in one chart.
#include <QCheckBox>
#include <QHeaderView>
#include <QLabel>
#include <QSignalSpy>
#include <QStyle>
#include <QTableWidget>
#include <QTest>
#include <QTreeWidget>
#include <algorithm>

#include "core/spec/error.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/compare_page.h"
#include "ui/charts/plot_widget.h"

using namespace btr;
using namespace btr::ui;

namespace {

RunRecord run(Id id, std::uint64_t seed, int population, const char* reality = "person") {
  RunRecord record;
  record.id = id;
  record.experiment = 1;
  record.seed = seed;
  record.reality = reality;
  record.programVersion = "0.1.0";
  record.specJson = QString(R"({"name": "kick", "seed": %1, "learner": {"name": "ga", "settings": {"population": %2}},
    "adapted": ["friction", "slip1"]})")
                        .arg(seed)
                        .arg(population)
                        .toStdString();
  record.sceneJson = R"({"robots": [{"name": "dog", "servos": {"knee": {"p": 4.5}}}], "gravity_m_s2": [0, 0, -9.81]})";
  return record;
}

const SpecRow* find(const std::vector<SpecRow>& rows, const char* key) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](auto& row) { return row.key == key; });
  return found == rows.end() ? nullptr : &*found;
}

ComparePage::History history(double best) {
  GenerationRecord generation;
  generation.number = 1;
  generation.best = best;
  return {{generation}, {}, {}, "m"};
}

/// Answers at once whatever the page wants.
void answer(ComparePage& page, const std::function<ComparePage::History(Id run)>& history) {
  QObject::connect(&page, &ComparePage::wanted, &page, [&page, history](const std::vector<Id>& runs) {
    std::map<Id, ComparePage::History> histories;
    for (const Id run : runs) histories[run] = history(run);
    page.setHistories(histories);
  });
}

}  // namespace

class TestComparePage : public QObject {
  Q_OBJECT

 private slots:
  void onlyWhatDiffersIsMarked() {
    RunRecord second = run(2, 7, 60, "stand_in");
    second.sceneJson = R"({"gravity_m_s2": [0, 0, -9.5], "robots": [{"name": "dog", "servos": {"knee": {"p": 4.5}}}]})";
    const auto rows = compareSpecs({run(1, 7, 30), second});
    QStringList different;
    for (const SpecRow& row : rows)
      if (row.differs) different << row.key;
    QCOMPARE(different, (QStringList{"learner.settings.population", "reality", "scene gravity_m_s2"}));
    QCOMPARE(find(rows, "learner.settings.population")->values, (QStringList{"30", "60"}));
    QCOMPARE(find(rows, "reality")->values, (QStringList{"person", "stand-in reality"}));
    QCOMPARE(find(rows, "scene gravity_m_s2")->values, (QStringList{"[0, 0, -9.81]", "[0, 0, -9.5]"}));
    QCOMPARE(find(rows, "scene robots.dog.servos.knee.p")->values, (QStringList{"4.5", "4.5"}));
    QCOMPARE(find(rows, "adapted")->values[0], QString("[friction, slip1]"));
  }

  void aSettingThatOneRunLacksDiffers() {
    RunRecord second = run(2, 7, 30);
    second.specJson = R"({"name": "kick", "seed": 7, "learner": {"name": "ga"}, "adapted": ["friction", "slip1"]})";
    const auto rows = compareSpecs({run(1, 7, 30), second});
    QCOMPARE(find(rows, "learner.settings.population")->values, (QStringList{"30", "(default)"}));
    QVERIFY(find(rows, "learner.settings.population")->differs);
  }

  void modelFilesAreComparedByContent() {
    RunRecord a = run(1, 7, 30), b = run(2, 7, 30);
    a.files = {{"dog.wrl", "aaaabbbbccccdddd", ""}};
    b.files = {{"dog.wrl", "eeeebbbbccccdddd", ""}};
    QVERIFY(find(compareSpecs({a, b}), "file dog.wrl")->differs);
    QVERIFY(withoutSeed(a) != withoutSeed(b));
  }

  void runsThatDifferOnlyInTheirSeedBelongTogether() {
    QCOMPARE(withoutSeed(run(1, 7, 30)), withoutSeed(run(2, 8, 30)));
    QVERIFY(withoutSeed(run(1, 7, 30)) != withoutSeed(run(2, 7, 60)));
    QVERIFY(withoutSeed(run(1, 7, 30)) != withoutSeed(run(2, 7, 30, "stand_in")));
  }

  void damagedSpecsAreComparedAsTheyStand() {
    RunRecord broken = run(1, 7, 30);
    broken.specJson = "{nonsense";
    QCOMPARE(find(compareSpecs({broken, run(2, 7, 30)}), "specification")->values, (QStringList{"{nonsense", "–"}));
  }

  void tickedRunsAreDrawnAndTheirDifferencesListed() {
    ComparePage page;
    QList<Id> read;
    answer(page, [&](Id id) {
      read << id;
      return history(static_cast<double>(id));
    });
    page.setRuns({run(1, 7, 30), run(2, 8, 30), run(3, 7, 60)}, {{1, "Kick"}});
    QVERIFY(read.isEmpty());

    page.setChosen({1, 2, 3});
    QCOMPARE(read, (QList<Id>{1, 2, 3}));
    // 1 and 2 become mean and interval, 3 stays alone: maximum and average.
    QCOMPARE(page.plot().data().series.size(), std::size_t(3));
    QCOMPARE(page.plot().data().bands.size(), std::size_t(1));
    QCOMPARE(page.plot().data().series[0].points, (std::vector<QPointF>{{1, 1.5}}));
    QTableWidget& table = page.differences();
    QCOMPARE(table.columnCount(), 4);
    QCOMPARE(table.rowCount(), 2);
    QCOMPARE(table.item(0, 0)->text(), QString("learner.settings.population"));
    QCOMPARE(table.item(1, 0)->text(), QString("seed"));
    QCOMPARE(table.item(1, 2)->text(), QString("8"));

    for (auto* box : page.findChildren<QCheckBox*>())
      if (box->text() == "Join seeds") box->click();
    QCOMPARE(page.plot().data().series.size(), std::size_t(6));
    for (auto* box : page.findChildren<QCheckBox*>())
      if (box->text() == "Only what differs") box->click();
    QVERIFY(table.rowCount() > 6);
    QCOMPARE(read.size(), 3);
    page.refresh();
    QCOMPARE(read.size(), 6);
  }

  // As wide as its dock in a small window, and in a large one.
  void theNamesOfTheRunsAreReadAtAnyWidth() {
    ComparePage page;
    page.setRuns({run(1, 7, 30, "stand_in"), run(12, 8, 30, "stand_in")},
                 {{1, "Learning to kick, short, with a stand-in reality"}});
    const auto* tree = page.findChild<QTreeWidget*>();
    for (const int width : {320, 700, 1200}) {
      page.resize(width, 520);
      page.show();
      QCoreApplication::processEvents();
      const QTreeWidgetItem* of = tree->topLevelItem(0)->child(1);
      const QRect cell = tree->visualItemRect(of) & tree->viewport()->rect();
      const int room = qMin(cell.right(), tree->header()->sectionSize(0)) - cell.left();
      const int box = page.style()->pixelMetric(QStyle::PM_IndicatorWidth);
      QVERIFY2(room >= box + tree->fontMetrics().horizontalAdvance(of->text(0)), qPrintable(QString::number(width)));
      QVERIFY2(page.minimumSizeHint().width() <= width, qPrintable(QString::number(page.minimumSizeHint().width())));
    }
  }

  void gapAndRealFitnessOfRunsThatDifferInTheirSeedBecomeMeansWithIntervals() {
    ComparePage page;
    answer(page, [&](Id id) {
      ComparePage::History all = history(1);
      // Gaps 0.1 and 0.3 of two seeds, 0.5 of the other experiment.
      all.stages = {{1, id == 1 ? 0.1 : id == 2 ? 0.3 : 0.5, 0, double(id), double(id)}};
      return all;
    });
    page.setRuns({run(1, 7, 30, "stand_in"), run(2, 8, 30, "stand_in"), run(3, 7, 60, "stand_in")}, {{1, "Kick"}});
    page.setChosen({1, 2, 3});
    const PlotData& plot = page.stages().data();
    QCOMPARE(plot.note, QString("stand-in reality"));
    QCOMPARE(plot.yTitle, QString("gap on unseen individuals (m)"));
    QCOMPARE(plot.series.size(), std::size_t(2));
    QCOMPARE(plot.series[0].points, (std::vector<QPointF>{{1, 0.2}}));
    // Half the difference times Student's t of one degree of freedom.
    QVERIFY(std::abs(plot.series[0].errors[0] - 0.1 * 12.7062) < 1e-5);
    QCOMPARE(plot.series[1].points, (std::vector<QPointF>{{1, 0.5}}));
    QCOMPARE(plot.series[1].errors, std::vector<double>{0.0});
    QVERIFY(plot.series[0].colour != plot.series[1].colour);
    // Fitness has an axis of its own.
    const PlotData& real = page.realFitness().data();
    QCOMPARE(real.yTitle, QString("real fitness (m)"));
    QCOMPARE(real.series[0].points, (std::vector<QPointF>{{1, 1.5}}));
    // 1.5 − 0.5·12.7 m lies far below 0: a kick's interval is drawn down to 0, exported as it is.
    QVERIFY(real.series[0].errors[0] > 1.5);
    page.realFitness().resize(600, 400);
    page.realFitness().resetZoom();
    QCOMPARE(page.realFitness().visibleRange().top(), 0.0);
    QCOMPARE(page.stages().visibleRange().top(), 0.0);
  }

  // A run that was duplicated twice with one seed: one draw, and one degree of freedom.
  void aSeedCountsOnce() {
    ComparePage page;
    answer(page, [&](Id id) {
      ComparePage::History all = history(1);
      all.stages = {{1, id == 1 ? 0.1 : 0.3, 0, 1, 1}};
      return all;
    });
    page.setRuns({run(1, 7, 30), run(2, 8, 30), run(5, 8, 30)}, {{1, "Kick"}});
    page.setChosen({1, 2, 5});
    const PlotData& plot = page.stages().data();
    QCOMPARE(plot.series.size(), std::size_t(1));
    QCOMPARE(plot.series[0].points, (std::vector<QPointF>{{1, 0.2}}));
    QVERIFY(std::abs(plot.series[0].errors[0] - 0.1 * 12.7062) < 1e-5);
    bool isSaid = false;
    for (const auto* label : page.findChildren<QLabel*>())
      isSaid = isSaid || label->text().contains("run 5 (as run 2)");
    QVERIFY(isSaid);
  }

  void whatWasReachedAtTheEndStandsInATable() {
    ComparePage page;
    answer(page, [&](Id id) {
      ComparePage::History all = history(1);
      all.stages = {{1, 9, 9, 9, 9}, {2, 0.1 * double(id), 0, double(id), double(id)}};
      return all;
    });
    page.setRuns({run(1, 7, 30), run(3, 7, 60)}, {{1, "Kick"}});
    page.setChosen({1, 3});
    const QTableWidget& table = page.reached();
    QCOMPARE(table.rowCount(), 2);
    const auto text = [&](int row, int column) { return table.item(row, column)->text(); };
    QCOMPARE(text(0, 1), QString("2"));
    QCOMPARE(text(0, 3), QString("0.1"));
    QCOMPARE(text(1, 4), QString("3"));
    QCOMPARE(text(0, 5), QString());
    QCOMPARE(text(1, 5), QString("0.2"));
    QCOMPARE(text(1, 6), QString("2"));
    QCOMPARE(table.horizontalHeaderItem(4)->text(), QString("real fitness (m)"));
  }

  void runsWithAnotherUnitAreLeftOutOfTheChartsAndNamed() {
    ComparePage page;
    answer(page, [](Id id) {
      ComparePage::History all = history(1);
      all.stages = {{1, 0.1, 0, 1, 1}};
      if (id == 2) all.unit = "cm/s";
      return all;
    });
    page.setRuns({run(1, 7, 30), run(2, 7, 40), run(3, 7, 60, "stand_in")}, {{1, "Kick"}});
    page.setChosen({1, 2, 3});
    QVERIFY(page.plot().data().yTitle.contains("(m)"));
    QCOMPARE(page.plot().data().series.size(), std::size_t(4));
    QCOMPARE(page.stages().data().series.size(), std::size_t(2));
    const auto* leftOut = page.findChild<QLabel*>("leftOut");
    QVERIFY2(leftOut->text().contains("run 2 (cm/s)") && !leftOut->isHidden(), qPrintable(leftOut->text()));
    QCOMPARE(page.differences().columnCount(), 4);
    // One of the runs drawn was measured by a person: both tabs say so.
    QCOMPARE(page.stages().data().note, QString("some runs in stand-in reality"));
    QCOMPARE(page.plot().data().note, page.stages().data().note);
    page.setChosen({2});
    QVERIFY(page.plot().data().yTitle.contains("(cm/s)"));
    QVERIFY(leftOut->isHidden());
  }

  void ticksStayWhenTheListIsReadAgain() {
    ComparePage page;
    page.setRuns({run(1, 7, 30), run(2, 8, 30)}, {{1, "Kick"}});
    page.setChosen({2});
    page.setRuns({run(1, 7, 30), run(2, 8, 30), run(3, 9, 30)}, {{1, "Kick"}});
    QCOMPARE(page.chosen(), std::vector<Id>{2});
  }

  // One after another they would be drawn and read as often as there are runs.
  void aTickBesideTheExperimentTakesAllItsRunsAtOnce() {
    ComparePage page;
    std::vector<RunRecord> runs;
    for (int i = 1; i <= 54; ++i) runs.push_back(run(i, std::uint64_t(i), 30));
    page.setRuns(runs, {{1, "Kick"}});
    QSignalSpy wanted(&page, &ComparePage::wanted);
    page.findChild<QTreeWidget*>()->topLevelItem(0)->setCheckState(0, Qt::Checked);
    QCOMPARE(page.chosen().size(), runs.size());
    QTRY_COMPARE(page.differences().columnCount(), 55);
    QCOMPARE(wanted.count(), 1);
    QCOMPARE(wanted.at(0).at(0).value<std::vector<Id>>().size(), runs.size());
  }

  // Nothing is emptied while the runs are read again, and what is missing is said.
  void whatIsThereStaysUntilTheAnswerComes() {
    ComparePage page;
    std::vector<Id> asked;
    connect(&page, &ComparePage::wanted, &page, [&](const std::vector<Id>& runs) { asked = runs; });
    page.setRuns({run(1, 7, 30), run(3, 7, 60)}, {{1, "Kick"}});
    page.setChosen({1});
    QCOMPARE(asked, std::vector<Id>{1});
    const auto isSaid = [&](const QString& text) {
      return std::ranges::any_of(page.findChildren<QLabel*>(), [&](const QLabel* l) { return l->text() == text; });
    };
    QVERIFY(isSaid("Reading…"));
    page.setHistories({{1, history(1)}});
    QVERIFY(!isSaid("Reading…"));
    const std::size_t curves = page.plot().data().series.size();
    QVERIFY(curves > 0);
    page.setChosen({1, 3});
    QCOMPARE(asked, std::vector<Id>{3});
    QCOMPARE(page.plot().data().series.size(), curves);
    QVERIFY(isSaid("Reading…"));
    page.refresh();
    QCOMPARE(asked, (std::vector<Id>{1, 3}));
    QCOMPARE(page.plot().data().series.size(), curves);
  }

  // While runs learn they are told four times a second: only those that went on are read again.
  void aRunThatWentOnIsReadAgain() {
    ComparePage page;
    std::vector<Id> asked;
    connect(&page, &ComparePage::wanted, &page, [&](const std::vector<Id>& runs) { asked = runs; });
    std::vector<RunRecord> runs{run(1, 7, 30), run(3, 7, 60)};
    page.setRuns(runs, {{1, "Kick"}});
    page.setChosen({1, 3});
    page.setHistories({{1, history(1)}, {3, history(3)}});
    asked.clear();
    page.setRuns(runs, {{1, "Kick"}});
    page.readOn();
    QVERIFY(asked.empty());
    ++runs[1].generation;
    page.setRuns(runs, {{1, "Kick"}});
    page.readOn();
    QCOMPARE(asked, std::vector<Id>{3});
    QCOMPARE(page.chosen(), (std::vector<Id>{1, 3}));
  }

  void aRunThatCannotBeReadSaysWhy() {
    ComparePage page;
    connect(&page, &ComparePage::wanted, &page, [&] { page.setHistories({}, "kick.db: the file is damaged"); });
    page.setRuns({run(1, 7, 30)}, {});
    page.setChosen({1});
    bool said = false;
    for (auto* label : page.findChildren<QLabel*>()) said |= label->text() == "kick.db: the file is damaged";
    QVERIFY(said);
  }
};

UI_TEST(TestComparePage)
#include "test_compare_page.moc"
