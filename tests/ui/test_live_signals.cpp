// Signals of a running world: chosen in the tree, kept of every control period, exported as a recording.
#include <QAction>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <cmath>

#include "core/gap/recordings/recording.h"
#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/look/message_banner.h"
#include "ui/live/panels/signal_picker.h"
#include "ui/live/panels/signals_panel.h"

using namespace btr;
using namespace btr::ui;

namespace {

QTreeWidgetItem* signalItem(QTreeWidget* tree, const QString& name) {
  for (QTreeWidgetItemIterator at(tree); *at; ++at)
    if ((*at)->data(0, Qt::UserRole).toString() == name) return *at;
  return nullptr;
}

const QStringList twenty{"dog.LF_J1.command_rad",
                         "dog.LF_J1.position_rad",
                         "dog.LF_J1.velocity_rad_s",
                         "dog.LF_J1.torque_nm",
                         "dog.LF_J2.command_rad",
                         "dog.LF_J2.position_rad",
                         "dog.LF_J2.torque_nm",
                         "dog.RF_J1.command_rad",
                         "dog.RF_J1.position_rad",
                         "dog.RF_J1.torque_nm",
                         "dog.RR_J3.command_rad",
                         "dog.RR_J3.position_rad",
                         "dog.RR_J3.torque_nm",
                         "dog.base.x_m",
                         "dog.base.y_m",
                         "dog.base.z_m",
                         "dog.base.speed_m_s",
                         "ball.x_m",
                         "ball.z_m",
                         "ball.speed_m_s"};

}  // namespace

class TestLiveSignals : public QObject {
  Q_OBJECT
 private slots:
  void everyControlPeriodOfTwentySignalsIsExportedAsARecording() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.action("liveShowSignals")->trigger();
    auto* tree = open.page.findChild<QTreeWidget*>("liveSignals");
    for (const QString& name : twenty) {
      QTreeWidgetItem* item = signalItem(tree, name);
      QVERIFY2(item, qPrintable(name));
      item->setCheckState(0, Qt::Checked);
    }
    // One more is one too many.
    signalItem(tree, "ball.y_m")->setCheckState(0, Qt::Checked);
    QCOMPARE(signalItem(tree, "ball.y_m")->checkState(0), Qt::Unchecked);
    QVERIFY(open.page.findChild<MessageBanner*>()->text().contains("20"));

    open.action("livePlay")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(open.page.row().period >= 625, 60000);  // 5 s of 8 ms
    open.action("livePlay")->trigger();
    QTRY_VERIFY(!open.page.row().playing);
    open.page.signalsPanel().draw();
    open.picture("signals");
    const auto expected = std::size_t(open.page.row().period);

    const QString file = open.folder.filePath("signals.csv");
    open.page.signalsPanel().exportTo(file);
    const Recording recording = loadRecording(file.toStdString());
    QCOMPARE(recording.rows(), expected);
    QCOMPARE(recording.channels.size(), std::size_t(21));
    for (std::size_t row = 0; row < recording.rows(); ++row)
      QVERIFY(std::abs(recording.columns[0][row] - 0.008 * double(row + 1)) < 1e-9);
    QCOMPARE(open.page.signalsPanel().record().missing(), 0L);
    for (const QString& name : twenty) {
      const int column = recording.column(name.toStdString());
      QVERIFY2(column > 0, qPrintable(name));
      // A speed is a difference: the first row has none.
      for (std::size_t row = 1; row < recording.rows(); ++row)
        QVERIFY(std::isfinite(recording.columns[std::size_t(column)][row]));
    }
    // It walks: what a servo reached follows what it was told.
    const auto& command = recording.columns[std::size_t(recording.column("dog.LF_J1.command_rad"))];
    QVERIFY(*std::ranges::max_element(command) - *std::ranges::min_element(command) > 0.05);
  }

  // How long the window is busy with it is printed, not judged: machines differ.
  void aMinuteOfTwentySignalsIsDrawn() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.action("liveShowSignals")->trigger();
    SignalsPanel& panel = open.page.signalsPanel();
    for (const QString& name : twenty) QVERIFY(panel.picker().choose(name.toStdString(), true));
    LiveSamples samples;
    samples.channels = panel.record().channels();
    for (long period = 1; period <= 7500; ++period) {
      samples.periods.push_back(period);
      samples.values.push_back(0.008 * double(period));
      for (std::size_t i = 1; i < samples.channels.size(); ++i)
        samples.values.push_back(std::sin(0.05 * double(period) + double(i)));
    }
    QElapsedTimer timer;
    timer.start();
    emit open.page.process().sampled(samples);
    const qint64 taken_ms = timer.restart();
    panel.draw();
    const qint64 drawn_ms = timer.restart();
    panel.grab();
    qInfo() << "7500 periods of 20 signals: taken in" << taken_ms << "ms, whole in the plots in" << drawn_ms
            << "ms, painted in" << timer.elapsed() << "ms";
    QCOMPARE(panel.record().rows(), std::size_t(7500));
    QCOMPARE(panel.record().missing(), 0L);
  }

  void aThrownBallsSpeedIsTheOneItWasThrownWith() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.page.signalsPanel().picker().choose("ball.speed_m_s", true);
    open.page.process().act(PlaceAct{"ball", {0.1, 0, 1}, {1, 0, 0, 0}, {}});
    open.page.process().act(ThrowAct{"ball", {2, 0, 0}, {0, 0, 0}});
    open.page.process().step(3);
    const SignalRecord& record = open.page.signalsPanel().record();
    QTRY_COMPARE(record.rows(), std::size_t(3));
    QVERIFY(std::isnan(record.value(0, 0)));
    for (const int k : {1, 2}) {
      // Falling: between periods k and k + 1 the vertical speed is between g·k·h and g·(k + 1)·h.
      const double h = 0.008, g = 9.81, speed = record.value(std::size_t(k), 0);
      QVERIFY(speed > std::hypot(2, g * h * k) - 1e-6 && speed < std::hypot(2, g * h * (k + 1)) + 1e-6);
    }
  }

  // Until its robot comes back; what was recorded stays.
  void aSignalOfARobotThatIsTakenAwayIsKept() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.action("liveShowSignals")->trigger();
    auto* tree = open.page.findChild<QTreeWidget*>("liveSignals");
    auto* picker = open.page.findChild<SignalPicker*>();
    const auto isChosen = [&] {
      QTreeWidgetItem* item = signalItem(tree, "dog.LF_J1.position_rad");
      return item && item->checkState(0) == Qt::Checked;
    };
    signalItem(tree, "dog.LF_J1.position_rad")->setCheckState(0, Qt::Checked);
    open.page.process().step(20);
    QTRY_COMPARE(open.page.row().period, 20L);
    open.select("dog");
    open.action("liveRemove")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(2));
    QVERIFY(isChosen());
    open.page.process().step(10);
    QTRY_COMPARE(open.page.row().period, 30L);
    open.action("liveUndo")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(3));
    QVERIFY(isChosen());
    open.page.process().step(10);
    QTRY_COMPARE(open.page.row().period, 40L);
    QTemporaryDir folder;
    const QString csv = folder.filePath("signals.csv");
    open.page.findChild<SignalsPanel*>()->exportTo(csv);
    const QStringList lines = QString::fromStdString(readFile(csv.toStdString())).trimmed().split('\n');
    QCOMPARE(lines.size(), 41);
    for (const auto& [line, known] : {std::pair{1, true}, {20, true}, {25, false}, {40, true}})
      QCOMPARE(!lines[line].endsWith(','), known);
    // No line leads over the time in which it was gone.
    auto* plot = open.page.findChild<SignalsPanel*>()->findChild<PlotWidget*>();
    QTRY_VERIFY(!plot->drawnPoints("dog.LF_J1.position").empty());
    for (const QPointF& point : plot->drawnPoints("dog.LF_J1.position")) QVERIFY(point.x() < 20.5 * 0.008);
    // Another world has none of them; one that is gone can be left out by hand.
    open.select("dog");
    open.action("liveRemove")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(2));
    signalItem(tree, "dog.LF_J1.position_rad")->setCheckState(0, Qt::Unchecked);
    QVERIFY(picker->chosen().empty());
  }

  void plotsByUnitCursorAndHold() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.action("liveShowSignals")->trigger();
    SignalsPanel& panel = open.page.signalsPanel();
    for (const char* name : {"dog.LF_J1.position_rad", "dog.LF_J1.torque_nm", "dog.LF_J1.command_rad"})
      QVERIFY(panel.picker().choose(name, true));
    QVERIFY(panel.plot("rad") && panel.plot("N·m") && !panel.plot("m"));
    open.page.process().step(100);
    QTRY_COMPARE(panel.record().rows(), std::size_t(100));
    panel.draw();
    QCOMPARE(panel.plot("rad")->data().series.size(), std::size_t(2));
    QCOMPARE(panel.plot("rad")->data().series[0].points.size(), std::size_t(100));
    auto* values = panel.findChild<QTableWidget*>("liveSignalValues");
    QCOMPARE(values->rowCount(), 3);
    QCOMPARE(values->item(1, 2)->text(), QString("N·m"));
    panel.findChild<QDoubleSpinBox*>("liveSignalsCursor")->setValue(0.4);
    QCOMPARE(panel.record().rowAt(0.4), std::size_t(49));
    QCOMPARE(values->item(0, 1)->text().replace("−", "-").toDouble(),
             QString::number(panel.record().value(49, 0), 'g', 4).toDouble());
    // Held plots stand, the record goes on.
    panel.findChild<QToolButton*>("liveSignalsPause")->click();
    open.page.process().step(50);
    QTRY_COMPARE(panel.record().rows(), std::size_t(150));
    QTest::qWait(250);
    QCOMPARE(panel.plot("rad")->data().series[0].points.size(), std::size_t(100));
    panel.findChild<QToolButton*>("liveSignalsClear")->click();
    QCOMPARE(panel.record().rows(), std::size_t(0));
    // Found by a part of its name.
    auto* tree = panel.findChild<QTreeWidget*>("liveSignals");
    panel.findChild<QLineEdit*>("liveSignalSearch")->setText("LF_J1.torque");
    QVERIFY(!signalItem(tree, "dog.LF_J1.torque_nm")->isHidden());
    QVERIFY(signalItem(tree, "dog.LF_J1.position_rad")->isHidden());
  }

  void aRecordForgetsWhatIsOldAndWhatWasUndone() {
    SignalRecord record;
    record.setSignals({{"a.x_m", {"a.x_m"}}});
    record.setSpan_s(1);
    const std::vector<std::string> channels = record.channels();
    QCOMPARE(channels, (std::vector<std::string>{"time_s", "a.x_m"}));
    for (long period = 1; period <= 20000; ++period)
      record.add(period, channels, std::vector<double>{double(period) * 0.01, double(period)});
    QCOMPARE(record.rows(), std::size_t(101));
    QCOMPARE(record.value(100, 0), 20000.0);
    QCOMPARE(record.missing(), 0L);
    // Put back by 50 periods.
    record.add(19951, channels, std::vector<double>{199.51, 7});
    QCOMPARE(record.rows(), std::size_t(52));
    QCOMPARE(record.value(51, 0), 7.0);
    record.add(19953, channels, std::vector<double>{199.53, std::nan("")});
    QCOMPARE(record.missing(), 1L);
    QVERIFY(record.toCsv().ends_with("199.51,7\n199.53,\n"));
    // A signal that comes later has no earlier values; the others keep theirs.
    record.setSignals({{"b.y_m", {"b.y_m"}}, {"a.x_m", {"a.x_m"}}});
    QVERIFY(std::isnan(record.value(0, 0)));
    QCOMPARE(record.value(0, 1), 19900.0);
  }
};

UI_TEST(TestLiveSignals)
#include "test_live_signals.moc"
