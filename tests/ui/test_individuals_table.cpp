// The table of individuals: sorting, filters, selection, CSV, many rows.
#include <QAbstractItemModelTester>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QLabel>
#include <QPlainTextEdit>
#include <QSignalSpy>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <QTimer>

#include "core/gap/report/report_plain.h"
#include "core/spec/error.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/short_label.h"
#include "ui/database/individual_details.h"
#include "ui/database/individuals_table.h"

using namespace btr;
using namespace btr::ui;

namespace {

IndividualRecord individual(Id id, int generation, int slot, double fitness, const char* chromosome) {
  IndividualRecord record;
  record.id = id;
  record.run = 1;
  record.generation = generation;
  record.slot = slot;
  record.simulator = 40;
  record.fitness = fitness;
  record.chromosome = chromosome;
  record.parameters = {0.5, fitness};
  return record;
}

std::vector<IndividualRecord> example() {
  std::vector<IndividualRecord> all{individual(1, 1, 0, 0.2, "00000000"), individual(2, 1, 1, 0.5, "00000001"),
                                    individual(3, 2, 0, 0.5, "00000001"), individual(4, 2, 1, 0.1 + 0.2, "00000010"),
                                    individual(5, 2, 2, -1, "00000011")};
  all[2].sameAs = 2;
  all[4].outcome = "exploded";
  all[4].detail = "left the field at 0.8 s";
  return all;
}

std::vector<MeasurementRecord> measurements() {
  std::vector<MeasurementRecord> all(4);
  all[0].individual = 2, all[0].value = 0.4;
  all[1].individual = 2, all[1].value = 0.2;
  all[2].individual = 2, all[2].value = 9, all[2].isVoid = true;
  all[3].individual = 5, all[3].value = 0, all[3].isVoid = true;
  return all;
}

QList<Id> shown(IndividualsTable& table) {
  QList<Id> ids;
  for (int row = 0; row < table.filter().rowCount(); ++row)
    ids << table.filter().recordAt(table.filter().index(row, 0)).id;
  return ids;
}

QCheckBox* box(IndividualsTable& table, const QString& text) {
  for (auto* candidate : table.findChildren<QCheckBox*>())
    if (candidate->text() == text) return candidate;
  return nullptr;
}

using M = IndividualsModel;

/// A reader that answers with the next turn of the event loop.
IndividualsTable::Reader later(const std::function<IndividualsTable::Page(int first, int last)>& page) {
  return [page](int first, int last, const IndividualsTable::Take& take, const IndividualsTable::Failed& failed) {
    QTimer::singleShot(0, qApp, [=] {
      try {
        take(page(first, last));
      } catch (const InputError& error) {
        failed(error.what());
      }
    });
  };
}

}  // namespace

class TestIndividualsTable : public QObject {
  Q_OBJECT

 private slots:
  void modelsKeepTheRulesOfItemModels() {
    IndividualsTable table;
    QAbstractItemModelTester model(&table.model(), QAbstractItemModelTester::FailureReportingMode::QtTest);
    QAbstractItemModelTester filter(&table.filter(), QAbstractItemModelTester::FailureReportingMode::QtTest);
    table.model().append(example());
    table.setMeasurements(measurements());
    table.filter().setBestDistinct(true);
    table.model().append({individual(9, 3, 0, 7, "00000001")});
    table.clear();
  }

  void cellsShowTheRecord() {
    IndividualsModel model;
    model.setUnit("m");
    SimulatorRecord simulator;
    simulator.id = 40;
    simulator.number = 3;
    model.setSimulators({simulator});
    model.append(example());
    model.setMeasurements(measurements());
    const auto text = [&](int row, int column) { return model.index(row, column).data().toString(); };
    QCOMPARE(model.headerData(M::fitness, Qt::Horizontal).toString(), QString("fitness (m)"));
    QCOMPARE(text(1, M::generation), QString("1"));
    QCOMPARE(text(1, M::fitness), QString("0.5"));
    QCOMPARE(text(1, M::simulator), QString("3"));
    QCOMPARE(text(2, M::sameAs), QString("2"));
    QCOMPARE(text(0, M::sameAs), QString());
    QCOMPARE(text(4, M::outcome), QString("exploded"));
    QCOMPARE(model.index(4, M::outcome).data(Qt::ToolTipRole).toString(), QString("left the field at 0.8 s"));
    QCOMPARE(text(1, M::measuredMean), QString("0.3"));
    QCOMPARE(text(1, M::measuredDeviation), QString("0.14"));
    QCOMPARE(text(1, M::measuredCount), QString("2"));
    QCOMPARE(text(1, M::voidCount), QString("1"));
    QCOMPARE(text(4, M::measuredMean), QString());
    QCOMPARE(text(4, M::voidCount), QString("1"));
    QCOMPARE(model.index(3, M::fitness).data(Qt::ToolTipRole).toString(), QString("0.30000000000000004 m"));
  }

  void anIndividualIsFoundByItsNumber() {
    IndividualsTable table;
    table.model().append(example());
    QCOMPARE(table.model().index(3, M::number).data().toString(), QString("4"));
    table.filter().setWords("4");
    QCOMPARE(shown(table), QList<Id>{4});
  }

  // Those that wait to be measured: neither their fitness nor their place by fitness is told, nor that of their
  // doubles.
  void whatNobodyShallKnowYetIsInNoAnswer() {
    IndividualsTable table;
    table.model().append(example());
    table.setHidden({2});
    for (const int row : {1, 2}) {
      QCOMPARE(table.model().index(row, M::fitness).data().toString(), QString("hidden"));
      QVERIFY(!table.model().index(row, M::fitness).data(M::SortRole).isValid());
      QVERIFY(!table.model().index(row, M::fitness).data(Qt::ToolTipRole).isValid());
    }
    table.view().sortByColumn(M::fitness, Qt::DescendingOrder);
    QCOMPARE(shown(table).mid(0, 3), (QList<Id>{4, 1, 5}));
    table.view().sortByColumn(M::fitness, Qt::AscendingOrder);
    QCOMPARE(shown(table).mid(0, 3), (QList<Id>{5, 1, 4}));
    QVERIFY(!table.model().toCsv({1}).contains("0.5"));
    QVERIFY(table.select(2));
    for (const auto* label : table.findChildren<QLabel*>())
      QVERIFY2(!label->text().contains("0.5") && !label->toolTip().contains("0.5"), qPrintable(label->text()));
    table.setHidden({});
    QCOMPARE(table.model().index(1, M::fitness).data().toString(), QString("0.5"));
  }

  // The detail of a kick tells how far it went, as well as its fitness does.
  void theDetailOfWhoIsMeasuredBlindIsInNoAnswerEither() {
    std::vector<IndividualRecord> all = example();
    all[1].detail = "way_m 1.234";
    IndividualsTable table;
    table.model().append(all);
    table.setHidden({2});
    QVERIFY(table.select(2));
    for (const auto* label : table.findChildren<QLabel*>())
      QVERIFY2(!label->text().contains("1.234") && !label->toolTip().contains("1.234"), qPrintable(label->text()));
    QVERIFY(!table.model().index(1, M::outcome).data(Qt::ToolTipRole).isValid());
    table.filter().setWords("1.234");
    QCOMPARE(shown(table), QList<Id>());
    table.setHidden({});
    QCOMPARE(table.model().index(1, M::outcome).data(Qt::ToolTipRole).toString(), QString("way_m 1.234"));
  }

  void aStandInIsNamedInTheHeader() {
    IndividualsModel model;
    model.setUnit("m");
    QCOMPARE(model.headerData(M::measuredMean, Qt::Horizontal).toString(), QString("measured mean (m)"));
    model.setStandIn(true);
    QCOMPARE(model.headerData(M::measuredMean, Qt::Horizontal).toString(), QString("stand-in mean (m)"));
  }

  void sortsByFitnessWithTheEarlierOfEqualsFirst() {
    IndividualsTable table;
    table.model().append(example());
    table.view().sortByColumn(M::fitness, Qt::DescendingOrder);
    QCOMPARE(shown(table), (QList<Id>{2, 3, 4, 1, 5}));
    table.view().sortByColumn(M::fitness, Qt::AscendingOrder);
    QCOMPARE(shown(table), (QList<Id>{5, 1, 4, 2, 3}));
  }

  void whatIsNotMeasuredComesLastInBothDirections() {
    IndividualsTable table;
    table.model().append(example());
    table.setMeasurements(measurements());
    table.view().sortByColumn(M::measuredMean, Qt::DescendingOrder);
    QCOMPARE(shown(table).front(), Id(2));
    table.view().sortByColumn(M::measuredMean, Qt::AscendingOrder);
    QCOMPARE(shown(table).front(), Id(2));
  }

  void bestDistinctShowsEachChromosomeOnceWhereItWasBest() {
    IndividualsTable table;
    table.model().append(example());
    box(table, "Best distinct")->click();
    QCOMPARE(shown(table), (QList<Id>{2, 4, 1, 5}));
    // A later, better one takes the place.
    table.model().append({individual(6, 3, 0, 0.9, "00000001")});
    QCOMPARE(shown(table), (QList<Id>{6, 4, 1, 5}));
  }

  void filtersByGenerationMeasurementAndWords() {
    IndividualsTable table;
    table.model().append(example());
    table.filter().setGenerations(2, 0);
    QCOMPARE(shown(table), (QList<Id>{3, 4, 5}));
    table.filter().setGenerations(0, 1);
    QCOMPARE(shown(table), (QList<Id>{1, 2}));
    table.filter().setGenerations(0, 0);
    table.filter().setWords("EXPL");
    QCOMPARE(shown(table), (QList<Id>{5}));
    table.filter().setWords("00000001");
    QCOMPARE(shown(table), (QList<Id>{2, 3}));
    table.filter().setWords("");
    box(table, "Measured")->click();
    QCOMPARE(shown(table), QList<Id>{});
    table.setMeasurements(measurements());
    QCOMPARE(shown(table), (QList<Id>{2}));
  }

  void selectingShowsChromosomeAndParametersWithUnits() {
    IndividualsTable table;
    table.setUnit("m");
    table.setGenotype({{"height_m", "m", "body above ground", 0.1, 0.9, 0.5, {}, false, {}},
                       {"points", "", "interpolation points", 1, 16, 4, {}, true, {}}});
    table.model().append(example());
    QSignalSpy selected(&table, &IndividualsTable::selectionChanged);
    QVERIFY(table.select(4));
    QCOMPARE(selected.last()[0].value<Id>(), Id(4));
    QCOMPARE(table.selected(), Id(4));
    auto* parameters = table.details().findChild<QTableWidget*>();
    QCOMPARE(parameters->rowCount(), 2);
    QCOMPARE(parameters->item(0, 0)->text(), QString("height_m"));
    QCOMPARE(parameters->item(0, 1)->text(), QString("0.5"));
    QCOMPARE(parameters->item(0, 2)->text(), QString("m"));
    QCOMPARE(parameters->item(0, 3)->text(), QString("0.1 to 0.9"));
    QCOMPARE(parameters->item(1, 1)->toolTip(), QString("0.30000000000000004"));
    QCOMPARE(table.details().findChild<QPlainTextEdit*>()->toPlainText(), QString("00000010"));
    QVERIFY(!table.select(999));
    QCOMPARE(groupedChromosome("0101101011"), QString("01011010 11"));
  }

  void enterAndDoubleClickAskForAReplay() {
    IndividualsTable table;
    table.resize(900, 400);
    table.model().append(example());
    table.show();
    QSignalSpy replay(&table, &IndividualsTable::replayRequested);
    table.select(3);
    QTest::keyClick(&table.view(), Qt::Key_Return);
    const QPoint place = table.view().visualRect(table.filter().index(0, 0)).center();
    QTest::mouseClick(table.view().viewport(), Qt::LeftButton, {}, place);
    QTest::mouseDClick(table.view().viewport(), Qt::LeftButton, {}, place);
    QCOMPARE(replay.count(), 2);
    QCOMPARE(replay[0][0].value<Id>(), Id(3));
    QCOMPARE(replay[1][0].value<Id>(), Id(1));
  }

  void csvHoldsTheRowsShownWithExactNumbers() {
    IndividualsTable table;
    table.setUnit("m");
    table.setStandIn(true);
    SimulatorRecord simulator;
    simulator.id = 40;
    table.setSimulators({simulator});
    table.model().append(example());
    table.setMeasurements(measurements());
    table.filter().setGenerations(1, 1);
    table.copyCsv();
    QCOMPARE(QApplication::clipboard()->text(),
             QString("individual,generation,slot,fitness_m,outcome,simulator,same_as_individual,measured_mean_m,"
                     "measured_sd_m,measured_count,void_count,reality,chromosome\n"
                     "1,1,0,0.2,finished,0,,,,0,0,,00000000\n"
                     "2,1,1,0.5,finished,0,,0.30000000000000004,0.14142135623730953,2,1,stand_in,00000001\n"));
  }

  void aLargeRunIsReadPageByPageWhileTheWindowGoesOn() {
    constexpr int generations = 500, population = 40;
    IndividualsTable table;
    QSignalSpy loaded(&table, &IndividualsTable::loaded);
    int turns = 0;
    QTimer other;
    connect(&other, &QTimer::timeout, this, [&] { ++turns; });
    other.start(0);
    table.load(generations, later([](int first, int) {
                 IndividualsTable::Page page{{}, first + 15};
                 for (int generation = first; generation < page.next; ++generation)
                   for (int slot = 0; slot < population && generation <= generations; ++slot)
                     page.individuals.push_back(individual(generation * 1000 + slot, generation, slot,
                                                           (slot * 7919 + generation * 31) % 1000, "01"));
                 return page;
               }));
    QCOMPARE(table.model().rowCount(), 0);
    QVERIFY(loaded.wait(20000));
    QCOMPARE(table.model().rowCount(), generations * population);
    QVERIFY2(turns >= 20, qPrintable(QString::number(turns)));

    table.view().sortByColumn(M::fitness, Qt::DescendingOrder);
    const auto fitness = [&](int row) { return table.filter().recordAt(table.filter().index(row, 0)).fitness; };
    for (int row = 1; row < generations * population; ++row) QVERIFY(fitness(row - 1) >= fitness(row));
  }

  void aGenerationThatIsStoredMeanwhileComesOnce() {
    IndividualsTable table;
    QSignalSpy loaded(&table, &IndividualsTable::loaded);
    const auto one = [](int first, int) {
      return IndividualsTable::Page{{individual(first, first, 0, 1, "0")}, first + 1};
    };
    table.load(1, later(one));
    table.extend(2);
    QVERIFY(loaded.wait(20000));
    QCOMPARE(table.model().rowCount(), 2);
    table.extend(2);
    table.extend(3);
    QVERIFY(loaded.wait(20000));
    QCOMPARE(table.model().rowCount(), 3);
  }

  void aPageOfTheRunBeforeComesTooLate() {
    IndividualsTable table;
    std::vector<IndividualsTable::Take> takes;
    const auto keep = [&](int, int, const IndividualsTable::Take& take, const auto&) { takes.push_back(take); };
    table.load(1, keep);
    table.load(1, keep);
    QCOMPARE(takes.size(), std::size_t(2));
    takes[1]({{individual(7, 1, 0, 1, "0")}, 2});
    takes[0]({{individual(1, 1, 0, 1, "0"), individual(2, 1, 1, 1, "1")}, 2});
    QCOMPARE(table.model().rowCount(), 1);
    QCOMPARE(table.model().at(0).id, Id(7));
  }

  void aReadingThatFailsSaysWhy() {
    IndividualsTable table;
    QSignalSpy loaded(&table, &IndividualsTable::loaded);
    table.load(3, later([](int first, int) {
                 if (first == 2) throw InputError("kick.db: the file is damaged");
                 return IndividualsTable::Page{{individual(first, first, 0, 1, "0")}, first + 1};
               }));
    QVERIFY(loaded.wait(20000));
    QCOMPARE(table.model().rowCount(), 1);
    QCOMPARE(table.findChild<ShortLabel*>("individualsCount")->whole(), QString("kick.db: the file is damaged"));
  }

  // A narrow window leaves no room for the words: then the number stands alone, and the words are its tool tip.
  void theCountIsNeverCut() {
    IndividualsTable table;
    table.model().append(example());
    const auto* count = table.findChild<ShortLabel*>("individualsCount");
    for (const int width : {690, 1200}) {
      table.resize(width, 300);
      table.show();
      QVERIFY(QTest::qWaitForWindowExposed(&table));
      QVERIFY2(count->width() >= count->fontMetrics().horizontalAdvance(count->text()), qPrintable(count->text()));
      QVERIFY(count->text().contains(QString::number(table.model().rowCount())));
      QVERIFY((count->text() + count->toolTip()).contains(tr("%1 individuals").arg(table.model().rowCount())));
    }
  }
};

UI_TEST(TestIndividualsTable)
#include "test_individuals_table.moc"
