// The run panel says where a run is and offers what fits.
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>

#include "tests/ui/ui_tests.h"
#include "ui/common/look/short_label.h"
#include "ui/experiment/run_panel.h"

using namespace btr;
using namespace btr::ui;

namespace {

RunRecord aRun(RunState state) {
  RunRecord run;
  run.id = 3;
  run.seed = 7;
  run.state = state;
  run.generation = 37;
  run.reality = "person";
  return run;
}

RunProgress progressIn(const std::string& stage) {
  RunProgress progress;
  progress.stage = stage;
  progress.generation = 37;
  progress.totalGenerations = 150;
  progress.stageDone = 37;
  progress.stageTotal = 50;
  progress.trials = 1110;
  progress.trialsPerSecond = 61.5;
  progress.secondsLeft = 125;
  progress.best = 0.5;
  progress.mean = 0.75;
  return progress;
}

struct Shown {
  QString stage, next, best, speed, left;
  bool go, stop, standIn;
};

Shown show(RunPanel& panel, const RunRecord& run, const RunProgress& progress, bool active) {
  GenerationRecord last;
  last.run = run.id;
  last.number = run.generation;
  last.best = 0.8125;
  last.mean = 0.25;
  panel.setGenerations({last});
  panel.setUnit("m");
  panel.show();
  panel.showRun(run, progress, active);
  const auto text = [&](const char* name) {
    return panel.findChild<QLabel*>(name)->text().replace(QChar(0x202f), ' ');
  };
  return {panel.findChild<ShortLabel*>("stage")->whole(),
          text("next"),
          text("best"),
          text("speed"),
          text("left"),
          panel.findChild<QPushButton*>("go")->isEnabled(),
          panel.findChild<QPushButton*>("stop")->isEnabled(),
          panel.findChild<QLabel*>("standIn")->isVisible()};
}

}  // namespace

class TestRunPanel : public QObject {
  Q_OBJECT
 private slots:
  void showsALearningRunWithItsNumbers() {
    RunPanel panel;
    const Shown shown = show(panel, aRun(RunState::learning), progressIn("L1"), true);
    QCOMPARE(shown.stage, QString("L1 · learning in simulation"));
    QCOMPARE(shown.next, QString("In 13 generations the best wait for real fitness."));
    QCOMPARE(shown.best, QString("0.8125 m"));
    QCOMPARE(shown.speed, QString("61.5 trials/s"));
    QCOMPARE(shown.left, QString("2 min 05 s"));
    QVERIFY(!shown.go);
    QVERIFY(shown.stop);
    QVERIFY(!shown.standIn);
    QCOMPARE(panel.findChild<QProgressBar*>("overall")->value(), 37);
    QCOMPARE(panel.findChild<QProgressBar*>("overall")->maximum(), 150);
    QCOMPARE(panel.findChild<QProgressBar*>("within")->maximum(), 50);
  }

  void aRunThatNobodyWorksOnIsInterruptedAndCanBeContinued() {
    RunPanel panel;
    const Shown shown = show(panel, aRun(RunState::learning), progressIn("L1"), false);
    QCOMPARE(shown.stage, QString("Interrupted"));
    QVERIFY(shown.next.contains("same bits"));
    QVERIFY(shown.go);
    QVERIFY(!shown.stop);
    QCOMPARE(shown.speed, QString("–"));
  }

  // A narrow panel says the same in fewer words instead of cutting its buttons off.
  void isBriefWhereItIsNarrow() {
    RunPanel panel;
    RunRecord run = aRun(RunState::adapting);
    run.reality = "stand_in";
    show(panel, run, progressIn("L3"), true);
    const auto* stage = panel.findChild<QLabel*>("stage");
    panel.resize(panel.sizeHint());
    QCoreApplication::processEvents();
    QCOMPARE(stage->text(), QString("L3 · adapting the simulator"));
    const int whole = panel.width();
    panel.resize(panel.minimumSizeHint().width(), panel.height());
    QCoreApplication::processEvents();
    QVERIFY(panel.width() < whole - 100);
    QCOMPARE(stage->text(), QString("L3 · adapting"));
    for (const auto* label : {stage, panel.findChild<const QLabel*>("standIn")})
      QVERIFY(label->width() >= label->fontMetrics().horizontalAdvance(label->text()));
    QVERIFY(panel.rect().contains(panel.findChild<QWidget*>("stop")->geometry()));
  }

  void saysHowManyAreMeasuredWhileWaiting() {
    RunPanel panel;
    show(panel, aRun(RunState::waiting), progressIn("measuring"), false);
    panel.setMeasuring({7, 10});
    QCOMPARE(panel.findChild<ShortLabel*>("stage")->whole(), QString("Waiting for real fitness"));
    auto* next = panel.findChild<QLabel*>("next");
    QVERIFY(next->text().contains("7 of 10"));
    QVERIFY(next->text().startsWith("Measure on the real robot"));
    RunRecord byFolder = aRun(RunState::waiting);
    byFolder.reality = "csv_folder";
    show(panel, byFolder, progressIn("measuring"), false);
    panel.setMeasuring({7, 10});
    QVERIFY2(next->text().startsWith("“csv_folder” measures"), qPrintable(next->text()));
    QVERIFY(next->text().contains("7 of 10"));
    show(panel, aRun(RunState::waiting), progressIn("measuring"), false);
    panel.setMeasuring({7, 10});
    QCOMPARE(panel.findChild<QProgressBar*>("within")->value(), 7);
    panel.setMeasuring({10, 10});
    QVERIFY(panel.findChild<QLabel*>("next")->text().contains("press Continue to adapt the simulator"));
  }

  void saysThatL3GoesOnWhileAPersonMeasures() {
    RunPanel panel;
    RunProgress meanwhile = progressIn("L3");
    meanwhile.stageDone = 3;
    meanwhile.stageTotal = 20;
    QVERIFY(show(panel, aRun(RunState::waiting), meanwhile, true).stage.startsWith("Waiting for real fitness"));
    panel.setMeasuring({7, 10});
    QVERIFY(panel.findChild<ShortLabel*>("stage")->whole().contains("L3"));
    QVERIFY(panel.findChild<QLabel*>("next")->text().contains("7 of 10"));
    QCOMPARE(panel.findChild<QProgressBar*>("within")->text(), QString("measured 7 of 10 · L3 3 of 20"));
    QVERIFY(panel.findChild<QPushButton*>("stop")->isEnabled());
    panel.showRun(aRun(RunState::waiting), meanwhile, false);
    QCOMPARE(panel.findChild<QProgressBar*>("within")->text(), QString("measured 7 of 10"));
  }

  void showsTheErrorWhileTheSimulatorIsAdapted() {
    RunPanel panel;
    QCOMPARE(show(panel, aRun(RunState::adapting), progressIn("L3"), true).stage,
             QString("L3 · adapting the simulator"));
  }

  void whatL2LeftIsNoErrorOfL3() {
    RunPanel panel;
    RunProgress left = progressIn("L2");
    left.stageDone = 2;
    left.stageTotal = 4;
    const Shown shown = show(panel, aRun(RunState::adapting), left, true);
    QCOMPARE(shown.best, QString("–"));
    QVERIFY(!panel.findChild<QProgressBar*>("within")->isVisible());
    panel.showRun(aRun(RunState::adapting), progressIn("L3"), true);
    QCOMPARE(panel.findChild<QLabel*>("best")->text().replace(QChar(0x202f), ' '), QString("0.5 m"));
    QVERIFY(panel.findChild<QProgressBar*>("within")->isVisible());
  }

  void afterTheLastStageNothingFollows() {
    RunPanel panel;
    RunProgress last = progressIn("L3");
    QVERIFY(show(panel, aRun(RunState::adapting), last, true).next.contains("learning goes on"));
    last.totalGenerations = 37;
    QVERIFY(show(panel, aRun(RunState::adapting), last, true).next.contains("the run is finished"));
  }

  void oneGenerationIsNoPlural() {
    RunPanel panel;
    RunProgress progress = progressIn("L1");
    progress.stageDone = 49;
    QCOMPARE(show(panel, aRun(RunState::learning), progress, true).next,
             QString("In 1 generation the best wait for real fitness."));
  }

  void rightAfterTheLastValueTheRunGoesOnByItself() {
    RunPanel panel;
    show(panel, aRun(RunState::waiting), progressIn("measuring"), true);
    panel.setMeasuring({10, 10});
    QVERIFY(!panel.findChild<QLabel*>("next")->text().contains("press Continue"));
    QVERIFY(!panel.findChild<QPushButton*>("go")->isEnabled());
  }

  void aFinishedRunOffersNoStart() {
    RunPanel panel;
    const Shown shown = show(panel, aRun(RunState::finished), progressIn("finished"), false);
    QVERIFY(!shown.go);
    QVERIFY(!shown.stop);
  }

  void aFailedRunShowsItsMessage() {
    RunPanel panel;
    RunRecord run = aRun(RunState::failed);
    run.message = "disk full";
    const Shown shown = show(panel, run, progressIn("L1"), false);
    QVERIFY(shown.go);
    QCOMPARE(panel.findChild<QLabel*>("message")->text(), QString("disk full"));
  }

  void aRequestedStopIsSeenUntilTheProcessEnds() {
    RunPanel panel;
    RunRecord run = aRun(RunState::learning);
    run.stopRequested = true;
    const Shown shown = show(panel, run, progressIn("L1"), true);
    QCOMPARE(shown.stage, QString("Stopping …"));
    QVERIFY(!shown.stop);
    QVERIFY(!shown.go);
  }

  void labelsAStandInReality() {
    RunPanel panel;
    RunRecord run = aRun(RunState::learning);
    run.reality = "stand_in";
    QVERIFY(show(panel, run, progressIn("L1"), true).standIn);
  }

  void asksForTheRunThatItShows() {
    RunPanel panel;
    QSignalSpy go(&panel, &RunPanel::continueRequested), jobs(&panel, &RunPanel::jobsChanged);
    show(panel, aRun(RunState::ready), {}, false);
    QCOMPARE(panel.findChild<QPushButton*>("go")->text(), QString("Start"));
    QTest::mouseClick(panel.findChild<QPushButton*>("go"), Qt::LeftButton);
    QCOMPARE(go.count(), 1);
    QCOMPARE(go.first().first().value<Id>(), Id(3));
    panel.findChild<QSpinBox*>("jobs")->setValue(2);
    QCOMPARE(jobs.last().first().toInt(), 2);
  }

  void whileSomebodyMeasuresBlindTheBestIsHidden() {
    RunPanel panel;
    panel.setUnit("m");
    show(panel, aRun(RunState::waiting), progressIn("measuring"), false);
    GenerationRecord generation;
    generation.number = 50;
    generation.best = 1.117;
    generation.mean = 0.619;
    panel.addGenerations({generation});
    panel.setBlind(true);
    for (const auto* label : panel.findChildren<QLabel*>())
      QVERIFY2(!label->text().contains("1.117") && !label->text().contains("0.619"), qPrintable(label->text()));
    panel.setBlind(false);
    QVERIFY(panel.findChild<QLabel*>("best")->text().contains("1.117"));
  }

  void withoutARunItSaysWhatToDo() {
    RunPanel panel;
    panel.show();
    show(panel, aRun(RunState::learning), progressIn("L1"), true);
    panel.clear();
    QCOMPARE(panel.findChild<ShortLabel*>("stage")->whole(), QString("No run is selected"));
    QVERIFY(!panel.findChild<QPushButton*>("go")->isVisible());
  }

  void bestAndTrialsAreOfAllStoredGenerations() {
    RunPanel panel;
    const RunRecord run = aRun(RunState::learning);
    panel.showRun(run, progressIn("L1"), true);
    std::vector<GenerationRecord> all;
    for (const auto& [best, trials] : {std::pair{0.25, 30}, std::pair{1.125, 28}, std::pair{0.5, 29}}) {
      GenerationRecord generation;
      generation.run = run.id;
      generation.number = int(all.size()) + 1;
      generation.best = best;
      generation.mean = best / 2;
      generation.trials = trials;
      all.push_back(generation);
    }
    panel.setUnit("m");
    panel.setGenerations(all);
    const auto text = [&](const char* name) {
      return panel.findChild<QLabel*>(name)->text().replace(QChar(0x202f), ' ');
    };
    QCOMPARE(text("best"), QString("1.125 m"));
    QVERIFY(panel.findChild<QLabel*>("best")->toolTip().contains("generation 2"));
    QCOMPARE(text("mean"), QString("0.25 m"));
    QCOMPARE(text("trials"), QString("87"));
    // A process that was started again counts its own trials from 0; the run's stay.
    RunProgress restarted = progressIn("L1");
    restarted.trials = 3;
    panel.showRun(run, restarted, true);
    QCOMPARE(text("trials"), QString("87"));
    GenerationRecord next = all.back();
    next.number = 4;
    next.best = 0.75;
    next.trials = 10;
    panel.addGenerations({next});
    QCOMPARE(text("best"), QString("1.125 m"));
    QCOMPARE(text("trials"), QString("97"));
    // In the simulator that L3 made, fitness is another thing.
    next.number = 5;
    next.simulator = 2;
    next.best = 0.625;
    panel.addGenerations({next});
    QCOMPARE(text("best"), QString("0.625 m"));
    QVERIFY(panel.findChild<QLabel*>("best")->toolTip().contains("generation 5"));
  }
};

UI_TEST(TestRunPanel)
#include "test_run_panel.moc"
