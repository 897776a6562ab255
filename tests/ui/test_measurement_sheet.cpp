// The measurement sheet: typed, pasted, undone, voided, saved; blind until everything is entered.
#include <QAbstractItemModelTester>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QHeaderView>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <cmath>

#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/numbers/number_entry.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/measurement_view.h"
#include "ui/measure/question_bar.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// `count` individuals 101, 102, … whose drawn order runs backwards.
std::vector<MeasurementTask> tasks(int count, int wantedRepeats = 1) {
  std::vector<MeasurementTask> all;
  for (int i = 0; i < count; ++i) {
    MeasurementTask task;
    task.run = 5;
    task.stage = 2;
    task.individual = 101 + i;
    task.position = count - i;
    task.simulatedFitness = 0.875 + i;
    task.wantedRepeats = wantedRepeats;
    all.push_back(task);
  }
  return all;
}

MeasurementRecord saved(Id id, Id individual, double value, bool isVoid = false) {
  MeasurementRecord record;
  record.id = id;
  record.run = 5;
  record.individual = individual;
  record.value = value;
  record.isVoid = isVoid;
  record.who = "Ana";
  record.enteredAt = "2026-11-21T10:11:12Z";
  return record;
}

/// A sheet with a store: what is submitted comes back with ids.
struct Stored {
  MeasurementSheet sheet;
  std::vector<MeasurementRecord> records;
  explicit Stored(int count, int wantedRepeats = 1) {
    sheet.setUnit("m");
    sheet.setTasks(tasks(count, wantedRepeats));
    sheet.setWaiting(true);
    QObject::connect(&sheet, &MeasurementSheet::submitted, &sheet, [this](const std::vector<MeasurementRecord>& added) {
      for (MeasurementRecord record : added) {
        record.id = static_cast<Id>(records.size()) + 1;
        records.push_back(record);
      }
      sheet.setMeasurements(records);
    });
    sheet.resize(1000, 400);
    sheet.show();
    sheet.activateWindow();
    if (!QTest::qWaitForWindowActive(&sheet)) qFatal("the sheet's window did not become active");
    sheet.view().setFocus();
  }
  MeasurementModel& model() { return sheet.model(); }
  QString text(int row, int column) { return model().index(row, column).data().toString(); }
  void goTo(int row, int column) { sheet.view().setCurrentIndex(model().index(row, column)); }
  /// Keys go where the focus is: to the open editor, or to the table.
  void type(const QString& keys) {
    for (const QChar key : keys) QTest::keyClick(target(), key.toLatin1());
  }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    QTest::keyClick(target(), key, modifiers);
    QCoreApplication::processEvents();  // an editor closes after its key has been handled
  }
  QWidget* target() {
    auto* editor = qobject_cast<QLineEdit*>(QApplication::focusWidget());
    return editor ? static_cast<QWidget*>(editor) : &sheet.view();
  }
  QPushButton* button(const QString& text) {
    for (auto* candidate : sheet.findChildren<QPushButton*>())
      if (candidate->text() == text) return candidate;
    return nullptr;
  }
};

constexpr int first = MeasurementModel::firstRepeat;

}  // namespace

class TestMeasurementSheet : public QObject {
  Q_OBJECT

 private slots:
  void aNoteCanBeReadInANarrowSheetToo() {
    Stored s(3, 3);
    const auto wide = [&] { return s.sheet.view().columnWidth(s.model().noteColumn()); };
    const int least = s.sheet.view().fontMetrics().horizontalAdvance(QStringLiteral("fell over, mat"));
    s.sheet.resize(400, 300);
    QVERIFY2(wide() >= least, qPrintable(QString::number(wide())));
    s.sheet.resize(1800, 300);
    QCOMPARE(s.sheet.view().horizontalHeader()->length(), s.sheet.view().viewport()->width());
  }

  void theModelKeepsTheRulesOfItemModels() {
    MeasurementModel model;
    QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::QtTest);
    model.setTasks(tasks(3, 2));
    model.addRepeatColumn();
    model.write({{0, first, "1"}, {1, first + 4, "2"}}, "paste");
    model.setMeasurements({saved(1, 101, 1), saved(2, 102, 2)});
    model.undoStack().undo();
    model.setTasks(tasks(5));
    model.setTasks({});
  }

  void numbersAreReadAsTyped_data() {
    QTest::addColumn<QString>("typed");
    QTest::addColumn<QString>("shown");
    QTest::addColumn<double>("value");
    QTest::addColumn<bool>("converted");
    const double none = std::nan("");
    QTest::newRow("point") << " 0.53 "
                           << "0.53" << 0.53 << false;
    QTest::newRow("comma") << "0,53"
                           << "0.53" << 0.53 << true;
    QTest::newRow("typographic minus") << QString(QChar(0x2212)) + "2"
                                       << "-2" << -2.0 << false;
    QTest::newRow("exponent") << "1e-3"
                              << "1e-3" << 0.001 << false;
    QTest::newRow("thousands are ambiguous") << "1.234,5"
                                             << "1.234,5" << none << false;
    QTest::newRow("words") << "far"
                           << "far" << none << false;
    QTest::newRow("with unit") << "0.5 m"
                               << "0.5 m" << none << false;
    QTest::newRow("infinite") << "inf"
                              << "inf" << none << false;
    QTest::newRow("not a number") << "nan"
                                  << "nan" << none << false;
    QTest::newRow("too large") << "1e999"
                               << "1e999" << none << false;
    QTest::newRow("empty") << ""
                           << "" << none << false;
  }
  void numbersAreReadAsTyped() {
    QFETCH(QString, typed);
    QFETCH(QString, shown);
    QFETCH(double, value);
    QFETCH(bool, converted);
    const NumberEntry entry = readNumber(typed);
    QCOMPARE(entry.text, shown);
    QCOMPARE(entry.converted, converted);
    QCOMPARE(entry.value.has_value(), !std::isnan(value));
    if (entry.value) QCOMPARE(*entry.value, value);
  }

  void blocksAreSplitAsTheirTextSuggests_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QStringList>("cells");  // rows joined by |
    QTest::newRow("tabs") << "1\t2\n3\t4\n" << QStringList{"1|2", "3|4"};
    QTest::newRow("a column with Windows line ends") << "1\r\n2\r\n" << QStringList{"1", "2"};
    QTest::newRow("decimal commas") << "0,5\n0,6" << QStringList{"0,5", "0,6"};
    QTest::newRow("CSV") << "0.5,0.6\n0.7,0.8" << QStringList{"0.5|0.6", "0.7|0.8"};
    QTest::newRow("semicolons and decimal commas") << "0,5;0,6" << QStringList{"0,5|0,6"};
    QTest::newRow("thousands and a decimal comma") << "0,5\n1.234,5" << QStringList{"0,5", "1.234,5"};
    QTest::newRow("CSV of numbers below one") << "0.123,45" << QStringList{"0.123|45"};
    QTest::newRow("gap") << "1\n\n3" << QStringList{"1", "", "3"};
  }
  void blocksAreSplitAsTheirTextSuggests() {
    QFETCH(QString, text);
    QFETCH(QStringList, cells);
    QStringList found;
    for (const QStringList& row : cellsOf(text)) found << row.join('|');
    QCOMPARE(found, cells);
  }

  void rowsStandInTheDrawnOrder() {
    Stored s(3);
    QCOMPARE(s.text(0, MeasurementModel::individualColumn), QString("103"));
    QCOMPARE(s.text(2, MeasurementModel::individualColumn), QString("101"));
    QCOMPARE(s.model().headerData(first, Qt::Horizontal).toString(), QString("measured (m)"));
  }

  void enterGoesDownAndTabToTheNextCell() {
    Stored s(3, 2);
    s.goTo(0, first);
    s.type("0.5");
    s.press(Qt::Key_Return);
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(1, first));
    s.type("0.6");
    s.press(Qt::Key_Tab);
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(1, first + 1));
    s.type("0.7");
    s.press(Qt::Key_Down);
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(2, first + 1));
    s.type("0.8");
    s.press(Qt::Key_Up);
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(1, first + 1));
    QCOMPARE(s.text(0, first), QString("0.5"));
    QCOMPARE(s.text(1, first), QString("0.6"));
    QCOMPARE(s.text(1, first + 1), QString("0.7"));
    QCOMPARE(s.text(2, first + 1), QString("0.8"));
  }

  // Row by row as in a spreadsheet: Tab to the repeats, Enter to the next individual's first one.
  void enterAfterTabGoesToWhereTabBegan() {
    Stored s(3, 2);
    s.goTo(0, first);
    s.type("0.5");
    s.press(Qt::Key_Tab);
    s.type("0.6");
    s.press(Qt::Key_Return);
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(1, first));
    // Another key between them: down, as ever.
    s.press(Qt::Key_Tab);
    s.press(Qt::Key_Left);
    s.press(Qt::Key_Right);
    s.press(Qt::Key_Return);
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(2, first + 1));
  }

  void escapeLeavesACellAsItWas() {
    Stored s(2);
    s.goTo(0, first);
    s.type("0.5");
    s.press(Qt::Key_Escape);
    QCOMPARE(s.text(0, first), QString());
    QVERIFY(!s.model().hasUnsaved());
  }

  void aDecimalCommaIsConvertedForAllToSee() {
    Stored s(2);
    QSignalSpy told(&s.model(), &MeasurementModel::converted);
    s.goTo(0, first);
    s.type("0,53");
    s.press(Qt::Key_Return);
    QCOMPARE(s.text(0, first), QString("0.53"));
    QCOMPARE(told.count(), 1);
    QCOMPARE(told[0][0].toString(), QString("0,53 read as 0.53"));
  }

  void meanDeviationAndCountFollowTheRepeats() {
    Stored s(1, 2);
    s.model().write({{0, first, "0.4"}, {0, first + 1, "0.6"}}, "paste");
    QCOMPARE(s.text(0, s.model().meanColumn()), QString("0.50 ± 0.14"));  // s = 0.2/√2
    QCOMPARE(s.model().index(0, s.model().countColumn()).data().toInt(), 2);
    s.model().write({{0, first + 1, ""}}, "delete");
    QCOMPARE(s.text(0, s.model().meanColumn()), QString("0.4"));
  }

  void badInputIsMarkedAndSaysWhatIsAllowed() {
    Stored s(2);
    s.sheet.setAllowed({0.0, 3.0});
    QSignalSpy submitted(&s.sheet, &MeasurementSheet::submitted);
    for (const char* bad : {"far", "4", "-1", "nan"}) {
      s.model().write({{1, first, bad}, {0, first, "1"}}, "entry");
      const QModelIndex cell = s.model().index(1, first);
      QVERIFY(cell.data(Qt::BackgroundRole).value<QColor>().red() > 150);
      const QString tip = cell.data(Qt::ToolTipRole).toString();
      QVERIFY2(tip.contains(bad) && tip.contains("a number from 0 to 3 in m"), qPrintable(tip));
      QCOMPARE(s.model().firstInvalid(), cell);
      s.sheet.save();
      QCOMPARE(submitted.count(), 0);
      QCOMPARE(s.sheet.view().currentIndex(), cell);
    }
    s.model().write({{1, first, "2"}}, "entry");
    QVERIFY(!s.model().firstInvalid().isValid());
    QVERIFY(s.model().index(1, first).data(Qt::BackgroundRole).value<QColor>().blue() > 150);
    s.sheet.save();
    QCOMPARE(submitted.count(), 1);
  }

  void aBlockIsPastedFromTheCurrentCellAndUndoneInOneStep() {
    Stored s(3);
    QApplication::clipboard()->setText("0,1\t0,2\n0,3\t0,4\n");
    s.goTo(1, first);
    s.press(Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(s.model().repeatColumns(), 2);
    QCOMPARE(s.text(1, first), QString("0.1"));
    QCOMPARE(s.text(1, first + 1), QString("0.2"));
    QCOMPARE(s.text(2, first), QString("0.3"));
    QCOMPARE(s.text(2, first + 1), QString("0.4"));
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(!s.model().hasUnsaved());
    QTest::keyClick(&s.sheet.view(), Qt::Key_Y, Qt::ControlModifier);
    QCOMPARE(s.text(2, first + 1), QString("0.4"));
  }

  void aPastedNumberThatMayBeThousandsIsLeftOutAndSaid_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("above");
    QTest::addColumn<QString>("below");
    QTest::newRow("a point between decimal commas") << "0,5\n1.234"
                                                    << "0.5"
                                                    << "";
    QTest::newRow("a comma between decimal points") << "0.5\t\n1,234"
                                                    << "0.5"
                                                    << "";
    QTest::newRow("nothing beside it says so") << "1.2\n1.234"
                                               << "1.2"
                                               << "1.234";
    QTest::newRow("no thousands") << "1,234\n0,5"
                                  << "1.234"
                                  << "0.5";
  }
  void aPastedNumberThatMayBeThousandsIsLeftOutAndSaid() {
    QFETCH(QString, text);
    QFETCH(QString, above);
    QFETCH(QString, below);
    Stored s(2);
    QApplication::clipboard()->setText(text);
    s.goTo(0, first);
    s.press(Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(s.text(0, first), above);
    QCOMPARE(s.text(1, first), below);
    auto* banner = s.sheet.findChild<MessageBanner*>();
    QCOMPARE(banner->text().contains("thousands"), below.isEmpty());
  }

  void aPasteThatReachesBelowTheSheetKeepsWhatFits() {
    Stored s(2);
    QApplication::clipboard()->setText("1\n2\n3\n4");
    s.goTo(1, first);
    s.press(Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(s.text(1, first), QString("1"));
    QCOMPARE(s.text(0, first), QString());
    auto* banner = s.sheet.findChild<MessageBanner*>();
    QVERIFY2(banner->text().contains("2; 3; 4"), qPrintable(banner->text()));
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(banner->text(), QString());
  }

  void whatIsPastedOverAStoredValueIsSaidToBeLeftOut() {
    Stored s(2);
    s.records = {saved(1, 102, 0.25)};
    s.sheet.setMeasurements(s.records);
    QApplication::clipboard()->setText("0.31\n0.32");
    s.goTo(0, first);
    s.press(Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(s.text(0, first), QString("0.25"));
    QCOMPARE(s.text(1, first), QString("0.32"));
    QVERIFY(s.sheet.findChild<MessageBanner*>()->text().contains("0.31"));
  }

  // The simulator expects 0.875 and 1.875 m of these two.
  void aValueFarFromWhatIsExpectedIsAskedAboutBeforeItCounts() {
    Stored s(2);
    auto* question = s.sheet.findChild<QuestionBar*>();
    s.goTo(1, first);
    s.type("41");
    s.press(Qt::Key_Return);
    s.press(Qt::Key_S, Qt::ControlModifier);
    QVERIFY(question->isAsking());
    QVERIFY2(question->text().contains("Individual 101: 41 m"), qPrintable(question->text()));
    QVERIFY2(!question->text().contains("0.875") && !question->text().contains("1.875"), qPrintable(question->text()));
    QVERIFY(s.records.empty());
    QTest::mouseClick(question->no(), Qt::LeftButton);
    QVERIFY(!question->isAsking());
    QVERIFY(s.records.empty());
    QCOMPARE(s.sheet.view().currentIndex(), s.model().index(1, first));
    s.sheet.save();
    QTest::mouseClick(question->yes(), Qt::LeftButton);
    QCOMPARE(s.records.size(), std::size_t(1));
    QCOMPARE(s.records[0].value, 41.0);
  }

  void aQuestionEndsWithTheEditThatAnswersIt() {
    Stored s(2);
    auto* question = s.sheet.findChild<QuestionBar*>();
    s.model().write({{0, first, "1000000"}}, "entry");
    s.sheet.save();
    QVERIFY(question->isAsking());
    s.model().write({{0, first, "1"}}, "entry");
    QVERIFY(!question->isAsking());
    s.sheet.save();
    QCOMPARE(s.records.size(), std::size_t(1));
  }

  void theLastValuesOfAStageAreAskedAboutOnceWhereTheRunGoesOnByItself() {
    Stored s(2);
    s.sheet.setGoesOnByItself(true);
    auto* question = s.sheet.findChild<QuestionBar*>();
    s.model().write({{0, first, "1.1"}}, "entry");
    s.sheet.save();
    QCOMPARE(s.records.size(), std::size_t(1));
    s.model().write({{1, first, "1.2"}}, "entry");
    s.sheet.save();
    QVERIFY(question->isAsking());
    QCOMPARE(s.records.size(), std::size_t(1));
    QTest::mouseClick(question->no(), Qt::LeftButton);
    s.model().undoStack().undo();
    QCOMPARE(s.text(1, first), QString());
    s.model().undoStack().redo();
    s.sheet.save();
    QTest::mouseClick(question->yes(), Qt::LeftButton);
    QCOMPARE(s.records.size(), std::size_t(2));
    QVERIFY(!question->isAsking());
  }

  void aNoteAboutADecimalCommaEndsWithUndo() {
    Stored s(2);
    s.goTo(0, first);
    s.type("0,5");
    s.press(Qt::Key_Return);
    auto* banner = s.sheet.findChild<MessageBanner*>();
    QVERIFY(banner->text().contains("0,5 read as 0.5"));
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(banner->text(), QString());
  }

  void anErrorOfSavingEndsWhenItsCellIsMended() {
    Stored s(2);
    s.model().write({{0, first, "far"}, {1, first, "1"}}, "paste");
    s.sheet.save();
    auto* banner = s.sheet.findChild<MessageBanner*>();
    QVERIFY(banner->text().contains("far"));
    s.model().write({{0, first, "1"}}, "entry");
    QCOMPARE(banner->text(), QString());
  }

  void deleteClearsOnlyWhatIsNotSaved() {
    Stored s(2, 2);
    s.records = {saved(1, 102, 0.25)};
    s.sheet.setMeasurements(s.records);
    s.model().write({{0, first + 1, "0.5"}}, "entry");
    s.goTo(0, first);
    s.press(Qt::Key_Right, Qt::ShiftModifier);
    s.press(Qt::Key_Delete);
    QCOMPARE(s.text(0, first), QString("0.25"));
    QCOMPARE(s.text(0, first + 1), QString());
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(s.text(0, first + 1), QString("0.5"));
  }

  void undoAndRedoFollowTypedEntries() {
    Stored s(2);
    s.goTo(0, first);
    s.type("1");
    s.press(Qt::Key_Return);
    s.type("2");
    s.press(Qt::Key_Return);
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(s.text(1, first), QString());
    QCOMPARE(s.text(0, first), QString("1"));
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(s.text(0, first), QString());
    QTest::keyClick(&s.sheet.view(), Qt::Key_Y, Qt::ControlModifier);
    QTest::keyClick(&s.sheet.view(), Qt::Key_Y, Qt::ControlModifier);
    QCOMPARE(s.text(1, first), QString("2"));
  }

  void simulatedFitnessIsInNoAnswerWhileBlind() {
    Stored s(2);
    const auto leaks = [&] {
      for (int row = 0; row < 2; ++row)
        for (int column = 0; column < s.model().columnCount(); ++column)
          for (int role = 0; role < Qt::UserRole + 8; ++role)
            if (s.model().index(row, column).data(role).toString().contains("875")) return true;
      return false;
    };
    QVERIFY(!leaks());
    QVERIFY(s.sheet.view().isColumnHidden(MeasurementModel::simulatedColumn));

    auto* box = s.sheet.findChild<QCheckBox*>();
    QVERIFY(!box->isChecked());
    QVERIFY(!box->toolTip().isEmpty());
    box->click();
    QVERIFY(leaks());
    QVERIFY(!s.sheet.view().isColumnHidden(MeasurementModel::simulatedColumn));
    box->click();
    QVERIFY(!leaks());

    // Entered is not saved yet; after saving everything there is nothing left to influence.
    s.model().write({{0, first, "1"}, {1, first, "2"}}, "paste");
    QVERIFY(!leaks());
    s.sheet.save();
    QVERIFY(leaks());
    QVERIFY(!s.sheet.view().isColumnHidden(MeasurementModel::simulatedColumn));
  }

  void savingSubmitsRecordsAndMakesThemReadOnly() {
    Stored s(2, 2);
    s.sheet.setWho("Ana");
    s.model().write({{0, first, "0.5"}, {0, first + 1, "0,25"}, {0, s.model().noteColumn(), "slipped"}}, "entry");
    QTest::keyClick(&s.sheet.view(), Qt::Key_S, Qt::ControlModifier);

    QCOMPARE(s.records.size(), std::size_t(2));
    QCOMPARE(s.records[0].run, Id(5));
    QCOMPARE(s.records[0].individual, Id(102));
    QCOMPARE(s.records[0].value, 0.5);
    QCOMPARE(s.records[1].value, 0.25);
    QCOMPARE(s.records[1].note, std::string("slipped"));
    QCOMPARE(s.records[1].who, std::string("Ana"));
    QCOMPARE(s.records[1].source, std::string("person"));
    QVERIFY(!s.records[0].isVoid);

    QVERIFY(!s.model().hasUnsaved());
    QVERIFY(!s.model().undoStack().canUndo());
    QVERIFY(!(s.model().flags(s.model().index(0, first)) & Qt::ItemIsEditable));
    QVERIFY(s.model().index(0, first).data(Qt::ToolTipRole).toString().contains("by Ana"));
    QCOMPARE(s.text(0, s.model().noteColumn()), QString("slipped"));
    QCOMPARE(s.sheet.progressText(), QString("1 of 2 measured"));
  }

  void anOpenEditorCountsWhenSaving() {
    Stored s(1);
    s.goTo(0, first);
    s.type("0.75");
    QTest::keyClick(s.target(), Qt::Key_S, Qt::ControlModifier);
    QCOMPARE(s.records.size(), std::size_t(1));
    QCOMPARE(s.records[0].value, 0.75);
  }

  void whatTheStoreRefusesStaysUnsaved() {
    MeasurementSheet sheet;
    sheet.setTasks(tasks(1));
    sheet.model().write({{0, first, "1"}}, "entry");
    sheet.save();
    sheet.submissionFailed("disk full");
    sheet.setMeasurements({});
    QVERIFY(sheet.model().hasUnsaved());
    QCOMPARE(sheet.model().index(0, first).data().toString(), QString("1"));
    // A value that another program stored meanwhile does not take it away either.
    sheet.setMeasurements({saved(9, 101, 7)});
    QCOMPARE(sheet.model().index(0, first).data().toString(), QString("7"));
    QCOMPARE(sheet.model().index(0, first + 1).data().toString(), QString("1"));
  }

  void aVoidRowIsStoredAsOftenAsWantedAndCountsAsDone() {
    Stored s(2, 2);
    s.goTo(0, s.model().voidColumn());
    s.press(Qt::Key_Space);
    QCOMPARE(s.model().index(0, s.model().voidColumn()).data(Qt::CheckStateRole).toInt(), int(Qt::Checked));
    s.model().write({{0, s.model().noteColumn(), "fell"}}, "note");
    s.sheet.save();
    QCOMPARE(s.records.size(), std::size_t(2));
    for (const MeasurementRecord& record : s.records) {
      QVERIFY(record.isVoid);
      QCOMPARE(record.note, std::string("fell"));
    }
    QCOMPARE(s.sheet.progressText(), QString("0 of 2 measured, 1 void"));
    QCOMPARE(s.text(0, s.model().meanColumn()), QString("void"));
    QCOMPARE(s.model().index(0, s.model().countColumn()).data().toInt(), 0);
  }

  // Two repeats, one stored: ticked and saved, no 0 took its place and the value stayed valid.
  void aTickedRowVoidsWhatStandsInItAfterAsking() {
    Stored s(1, 2);
    s.records = {saved(1, 101, -2.5)};
    s.sheet.setMeasurements(s.records);
    QObject::connect(&s.sheet, &MeasurementSheet::voidRequested, &s.sheet,
                     [&](Id id, bool isVoid, const QString& note) {
                       for (MeasurementRecord& record : s.records)
                         if (record.id == id) record.isVoid = isVoid, record.note = note.toStdString();
                       s.sheet.setMeasurements(s.records);
                     });
    s.model().write({{0, s.model().noteColumn(), "fell"}}, "note");
    s.model().setVoid(0, true);
    QVERIFY(s.model().index(0, first).data(Qt::FontRole).value<QFont>().strikeOut());
    QCOMPARE(s.text(0, s.model().meanColumn()), QString("void"));
    const auto answer = [](bool yes) {
      QTimer::singleShot(0, qApp, [yes] {
        auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
        QVERIFY(box && box->informativeText().contains("individual 101: -2.5"));
        if (yes)
          box->findChild<QPushButton*>("voidStored")->click();
        else
          box->reject();
      });
    };
    answer(false);
    s.sheet.save();
    QVERIFY(!s.records[0].isVoid);
    QVERIFY(s.model().hasUnsaved());
    answer(true);
    s.sheet.save();
    QCOMPARE(s.records.size(), std::size_t(2));
    QVERIFY(s.records[0].isVoid && s.records[1].isVoid);
    QCOMPARE(s.records[0].value, -2.5);
    QCOMPARE(s.records[0].note, std::string("fell"));
    // The trial that never gave a number shows none.
    QCOMPARE(s.text(0, first), QString("-2.5"));
    QCOMPARE(s.text(0, first + 1), QString("void"));
    QVERIFY(!s.model().hasUnsaved());
  }

  void aTickOnARowWithAllItsValuesStoresNoFurtherOne() {
    Stored s(1);
    s.records = {saved(17, 101, 0.5)};
    s.sheet.setMeasurements(s.records);
    s.model().setVoid(0, true);
    QCOMPARE(s.model().toVoid().size(), std::size_t(1));
    QVERIFY(s.model().submit("Ana").empty());
    s.records[0].isVoid = true;
    s.sheet.setMeasurements(s.records);
    QVERIFY(!s.model().hasUnsaved());
  }

  void oneOfTwoTypedRepeatsCanBeVoid() {
    Stored s(1, 2);
    s.model().write({{0, first, "0.5"}, {0, first + 1, "9"}}, "entry");
    s.model().setValueVoid(s.model().index(0, first + 1), true);
    QVERIFY(s.model().index(0, first + 1).data(Qt::FontRole).value<QFont>().strikeOut());
    QCOMPARE(s.text(0, s.model().meanColumn()), QString("0.5"));
    s.sheet.save();
    QCOMPARE(s.records.size(), std::size_t(2));
    QVERIFY(!s.records[0].isVoid && s.records[1].isVoid);
    QCOMPARE(s.records[1].value, 9.0);
    QVERIFY(s.model().isComplete());
  }

  void aTrialThatFellIsTypedAsAWord() {
    Stored s(1, 2);
    s.goTo(0, first);
    s.type("Void");
    s.press(Qt::Key_Tab);
    s.type("0.5");
    s.press(Qt::Key_Return);
    QCOMPARE(s.text(0, first), QString("void"));
    QVERIFY(!s.model().firstInvalid().isValid());
    s.sheet.save();
    QCOMPARE(s.records.size(), std::size_t(2));
    QVERIFY(s.records[0].isVoid && !s.records[1].isVoid);
  }

  void aClickAnywhereInItsCellTogglesVoid() {
    Stored s(2);
    const QModelIndex cell = s.model().index(1, s.model().voidColumn());
    QTest::mouseClick(s.sheet.view().viewport(), Qt::LeftButton, {}, s.sheet.view().visualRect(cell).center());
    QCOMPARE(cell.data(Qt::CheckStateRole).toInt(), int(Qt::Checked));
    QTest::keyClick(&s.sheet.view(), Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(cell.data(Qt::CheckStateRole).toInt(), int(Qt::Unchecked));
  }

  void voidValuesAreStruckOutAndLeaveTheMean() {
    Stored s(1, 3);
    s.sheet.setMeasurements({saved(1, 101, 9, true), saved(2, 101, 0.5), saved(3, 101, 0.5)});
    QVERIFY(s.model().index(0, first).data(Qt::FontRole).value<QFont>().strikeOut());
    QCOMPARE(s.text(0, s.model().meanColumn()), QString("0.5 ± 0"));
    QVERIFY(s.model().isComplete());
  }

  void aSavedValueIsVoidedWithANote() {
    Stored s(1);
    s.sheet.setMeasurements({saved(17, 101, 9)});
    QSignalSpy asked(&s.sheet, &MeasurementSheet::voidRequested);
    QTimer::singleShot(0, [&] {
      auto* dialog = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
      dialog->setTextValue("typed wrongly");
      dialog->accept();
    });
    emit s.sheet.view().voidRequested(s.model().index(0, first));
    QCOMPARE(asked.count(), 1);
    QCOMPARE(asked[0][0].value<Id>(), Id(17));
    QCOMPARE(asked[0][1].toBool(), true);
    QCOMPARE(asked[0][2].toString(), QString("typed wrongly"));
  }

  void theReasonIsShownWithoutNumbersThatWouldTellTheSimulatedFitness() {
    Stored s(2);
    std::vector<MeasurementTask> two = tasks(2);
    two[0].rank = 3;
    two[1].disagreement = 0.21;
    two[1].candidates = 6;
    s.sheet.setTasks(two);
    const int reason = s.model().reasonColumn();
    // Drawn order runs backwards: the second task is the first row.
    QCOMPARE(s.text(0, reason), QString("candidate simulators disagree"));
    QCOMPARE(s.text(1, reason), QString("best"));
    s.sheet.setMeasurements({saved(1, 101, 0.5), saved(2, 102, 0.4)});
    QCOMPARE(s.text(0, reason), QString("candidate simulators disagree: ± 0.21 m over 6"));
    QCOMPARE(s.text(1, reason), QString("best, rank 3"));
    QVERIFY(!(s.model().flags(s.model().index(0, reason)) & Qt::ItemIsEditable));
  }

  void learningGoesOnWhenAllIsMeasuredOrVoidAndSaved() {
    Stored s(2);
    QSignalSpy go(&s.sheet, &MeasurementSheet::continueRequested);
    auto* button = s.button("Start learning again");
    QVERIFY(button && !button->isEnabled());
    s.model().write({{0, first, "1"}}, "entry");
    s.model().setVoid(1, true);
    QVERIFY(!button->isEnabled());
    s.sheet.save();
    QCOMPARE(s.sheet.progressText(), QString("1 of 2 measured, 1 void"));
    QVERIFY(button->isEnabled());
    QTest::mouseClick(button, Qt::LeftButton);
    QCOMPARE(go.count(), 1);
    s.sheet.setWaiting(false);
    QVERIFY(!button->isEnabled());
  }

  void aFurtherRepeatCanBeAddedToAMeasuredRow() {
    Stored s(1);
    s.sheet.setMeasurements({saved(1, 101, 0.5)});
    QCOMPARE(s.model().repeatColumns(), 1);
    s.model().addRepeatColumn();
    QCOMPARE(s.model().headerData(first + 1, Qt::Horizontal).toString(), QString("repeat 2 (m)"));
    s.goTo(0, first + 1);
    s.type("0.7");
    s.press(Qt::Key_Return);
    QCOMPARE(s.text(0, s.model().countColumn()), QString("2"));
  }

  void eachRowHasAReplayButton() {
    Stored s(2);
    QSignalSpy replay(&s.sheet, &MeasurementSheet::replayRequested);
    auto* button = qobject_cast<QToolButton*>(s.sheet.view().indexWidget(s.model().index(1, s.model().replayColumn())));
    QVERIFY(button);
    QTest::mouseClick(button, Qt::LeftButton);
    s.goTo(0, first);
    s.press(Qt::Key_R, Qt::ControlModifier);
    QCOMPARE(replay.count(), 2);
    QCOMPARE(replay[0][0].value<Id>(), Id(101));
    QCOMPARE(replay[1][0].value<Id>(), Id(102));
  }

  void whatIsNotAllowedIsSaidAtOnceAndUntilItIsMended() {
    Stored s(2);
    s.sheet.setAllowed({0.0, 3.0});
    s.goTo(0, first);
    s.type("7");
    s.press(Qt::Key_Return);
    auto* banner = s.sheet.findChild<MessageBanner*>();
    QVERIFY2(banner->text().contains("Individual 102") && banner->text().contains("from 0 to 3"),
             qPrintable(banner->text()));
    s.goTo(0, first);
    s.type("2");
    s.press(Qt::Key_Return);
    QCOMPARE(banner->text(), QString());
  }

  // What is clicked while a message comes must be the row that was aimed at.
  void aMessageMovesNoRow() {
    Stored s(4);
    const auto placeOf = [&](int row) {
      const QRect cell = s.sheet.view().visualRect(s.model().index(row, first));
      return s.sheet.view().viewport()->mapTo(&s.sheet, cell.topLeft());
    };
    const QPoint before = placeOf(2);
    s.goTo(0, first);
    s.type("abc");
    s.press(Qt::Key_Return);
    auto* banner = s.sheet.findChild<MessageBanner*>();
    QTRY_VERIFY(banner->isVisible() && banner->height() > 10);
    QCoreApplication::processEvents();
    QCOMPARE(placeOf(2), before);
  }

  void theProgressCountsWhatIsEnteredAndNotSaved() {
    Stored s(2);
    s.model().write({{0, first, "1"}, {1, first, "2"}}, "paste");
    QCOMPARE(s.sheet.progressText(), QString("0 of 2 measured · 2 entered, not saved yet"));
  }

  void anEarlierStageCanBeLookedAtAndCorrected() {
    Stored s(2);
    auto all = tasks(2);
    for (MeasurementTask later : tasks(2)) {
      later.stage = 3;
      later.individual += 100;
      all.push_back(later);
    }
    s.sheet.setTasks(all);
    s.records = {saved(1, 101, 0.5), saved(2, 102, 0.4)};
    s.sheet.setMeasurements(s.records);
    auto* stage = s.sheet.findChild<QComboBox*>("stage");
    QVERIFY(stage->isVisible());
    QCOMPARE(stage->currentText(), QString("Stage 3"));
    QCOMPARE(s.text(0, MeasurementModel::individualColumn), QString("202"));
    s.model().write({{0, first, "0.75"}}, "entry");
    stage->setCurrentIndex(0);
    emit stage->activated(0);
    QCOMPARE(s.text(0, MeasurementModel::individualColumn), QString("102"));
    QVERIFY(s.model().savedAt(s.model().index(0, first)));
    auto* title = s.sheet.findChild<QLabel*>("title");
    QVERIFY2(!title->text().contains("measure these"), qPrintable(title->text()));
    QVERIFY(!s.button("Start learning again")->isEnabled());
    // A poll leaves it; what was typed in the newest stage comes back with it.
    s.sheet.setTasks(all);
    QCOMPARE(stage->currentIndex(), 0);
    s.sheet.showNewest();
    QCOMPARE(s.text(0, first), QString("0.75"));
    QVERIFY(title->text().contains("measure these 2 individuals"));
  }

  void aSheetThatIsDoneOrdersNothing() {
    Stored s(1);
    auto* title = s.sheet.findChild<QLabel*>("title");
    QVERIFY(title->text().contains("measure these"));
    s.sheet.setWaiting(false);
    QVERIFY(!title->text().contains("measure these"));
    QVERIFY(title->text().contains("Stage 2: 1 individuals"));
  }

  void aDraftComesBackAsItWas() {
    Stored s(2, 2);
    s.model().write({{0, first, "0,5"}, {0, first + 1, "void"}, {1, s.model().noteColumn(), "„late“"}}, "entry");
    s.model().setVoid(1, true);
    const QString text = toText(s.model().draft());
    Stored again(2, 2);
    again.sheet.setDraft(draftFromText(text));
    QCOMPARE(again.model().draft(), s.model().draft());
    QCOMPARE(again.text(0, first), QString("0.5"));
    QCOMPARE(again.text(0, first + 1), QString("void"));
    auto* banner = again.sheet.findChild<MessageBanner*>();
    QVERIFY(banner->text().contains("not saved yet"));
    // In another stage nothing stands.
    auto all = tasks(2, 2);
    all.push_back(all.back());
    all.back().stage = 3;
    all.back().individual = 201;
    again.sheet.setTasks(all);
    QVERIFY(!banner->isVisible());
    QVERIFY(draftFromText("{\"rows\": 3").empty());
    QCOMPARE(toText(MeasurementDraft()), QString());
  }

  void theReplayButtonsStayInTheirColumn() {
    Stored s(2);
    const auto column = [&] { return s.model().replayColumn(); };
    const auto stands = [&](int row) {
      const QModelIndex cell = s.model().index(row, column());
      QWidget* button = s.sheet.view().indexWidget(cell);
      return button && s.sheet.view().visualRect(cell).contains(button->geometry().center());
    };
    s.model().addRepeatColumn();
    s.model().write({{0, first, "1"}, {1, first, "2"}}, "paste");
    s.sheet.save();
    QCoreApplication::processEvents();
    QVERIFY(stands(0) && stands(1));
  }

  void theSameTasksAgainKeepWhatWasTyped() {
    Stored s(2);
    s.model().write({{0, first, "0.5"}}, "entry");
    s.sheet.setTasks(tasks(2));
    QCOMPARE(s.text(0, first), QString("0.5"));
    auto other = tasks(2);
    for (MeasurementTask& task : other) task.stage = 3;
    s.sheet.setTasks(other);
    QCOMPARE(s.text(0, first), QString());
  }
};

UI_TEST(TestMeasurementSheet)
#include "test_measurement_sheet.moc"
