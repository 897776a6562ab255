#include <QComboBox>
#include <QLabel>
#include <QSemaphore>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <atomic>
#include <cmath>

#include "core/model/kinematics.h"
#include "core/spec/error.h"
#include "tests/ui/small_robot.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/cut_label.h"
#include "ui/common/numbers/format.h"
#include "ui/scene3d/replay_job.h"
#include "ui/scene3d/replay_panel.h"

using namespace btr;
using namespace btr::ui;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr double kPeriod = 0.008;

/// 0, 8, 16 … ms: `frames` of them.
std::vector<double> everyEightMilliseconds(int frames) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(i * kPeriod);
  return times;
}

/// The small robot walks 1 mm a frame along x, its joints turn 0.01 rad and lift 0.1 mm a frame; a ball rolls along y.
ReplayData someReplay(int frames = 251) {
  ReplayData data;
  data.model = test::smallRobot();
  data.robotName = "small";
  data.title = "kick, individual 7";
  data.fitnessUnit = "m";
  data.balls = {{"ball", 0.0425}};
  data.trace.channels = {"time_s",
                         "small.base.x_m",
                         "small.base.y_m",
                         "small.base.z_m",
                         "small.base.qw",
                         "small.base.qx",
                         "small.base.qy",
                         "small.base.qz",
                         "small.pitch.position_rad",
                         "small.lift.position_m",
                         "ball.x_m",
                         "ball.y_m",
                         "ball.z_m",
                         "ball.qw",
                         "ball.qx",
                         "ball.qy",
                         "ball.qz"};
  const double half = std::sqrt(0.5);  // the robot looks along y, the ball is turned by 90° about x
  for (int i = 0; i < frames; ++i)
    for (double value : {i * kPeriod, 0.001 * i, 0.0, 0.2, half, 0.0, 0.0, half, 0.01 * i, 0.0001 * i, 0.3, 0.002 * i,
                         0.0425, half, half, 0.0, 0.0})
      data.trace.values.push_back(value);
  return data;
}

std::unique_ptr<GlContext> noOpenGl(QString& problem) {
  problem = "no driver on this machine";
  return nullptr;
}

template <typename Widget>
Widget* named(QWidget& parent, const QString& name) {
  for (auto* child : parent.findChildren<Widget*>())
    if (child->accessibleName() == name) return child;
  return nullptr;
}

ReplayData titled(const QString& title) {
  ReplayData data;
  data.title = title;
  return data;
}

}  // namespace

class TestReplayPanel : public QObject {
  Q_OBJECT

 private slots:
  // A robot that is simulated is drawn: the badge says that this is the stored run.
  void everyRobotOfTheSceneIsDrawn() {
    ReplayData data = someReplay(3);
    data.others.push_back({"other", test::smallRobot(), Isometry3d::Identity()});
    for (const char* channel : {"other.base.x_m", "other.base.y_m", "other.base.z_m", "other.pitch.position_rad"})
      data.trace.channels.push_back(channel);
    const std::size_t before = data.trace.channels.size() - 4;
    std::vector<double> values;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < before; ++k) values.push_back(data.trace.values[row * before + k]);
      for (const double value : {-1.0, 0.5, 0.2, 0.1 * double(row)}) values.push_back(value);
    }
    data.trace.values = values;
    const ReplayFrames frames(data);
    const ScenePose pose = frames.pose(2);
    QCOMPARE(pose.others.size(), std::size_t(1));
    QCOMPARE(pose.others[0].size(), pose.links.size());
    QVERIFY((pose.others[0][0].translation() - Vector3d(-1, 0.5, 0.2)).norm() < 1e-12);

    // In the picture too: the same view with the second robot differs from the one without.
    SceneView view;
    if (const QString problem = view.problem(); !problem.isEmpty()) QSKIP(qPrintable("needs OpenGL: " + problem));
    view.setRobot(data.model);
    view.setPose(frames.pose(0));
    const QImage alone = view.picture({320, 240});
    view.setFurtherRobots(frames.otherModels());
    view.setPose(frames.pose(0));
    QVERIFY(view.picture({320, 240}) != alone);
  }

  void whatWasAskedForPlaysByItself() {
    ReplayPanel panel(nullptr, noOpenGl);
    ReplayJob job;
    panel.attach(job);
    job.start([] { return someReplay(); });
    QTRY_VERIFY(panel.playback().playing());
  }

  void twoIndividualsStandBesideEachOtherAtTheSameTime() {
    ReplayPanel panel(nullptr, noOpenGl);
    panel.resize(900, 500);
    panel.show();
    ReplayData both = someReplay(251);
    ReplayData other = someReplay(11);  // ends earlier
    other.title = "kick, individual 9";
    both.beside = std::make_shared<const ReplayData>(other);
    panel.setReplay(both);
    QVERIFY(panel.besideView() && panel.besideView()->isVisible());
    QVERIFY(std::abs(panel.besideView()->width() - panel.view().width()) <= 1);
    panel.showTime(1.0);
    QCOMPARE(panel.playback().timeOf(panel.playback().frame()), 1.0);
    // Turned together.
    ViewCamera camera = panel.view().camera();
    camera.orbit({40, 10});
    panel.view().setCamera(camera);
    QVERIFY(panel.besideView()->camera() == panel.view().camera());
    panel.setReplay(someReplay());
    QVERIFY(!panel.besideView()->isVisible());
  }

  void theFitnessOfWhoIsMeasuredBlindIsNotTold() {
    ReplayPanel panel(nullptr, noOpenGl);
    ReplayData data = someReplay(3);
    data.fitness = data.storedFitness = 0.6125;
    data.fitnessHidden = true;
    for (const auto check : {ReplayData::Check::identical, ReplayData::Check::differs}) {
      data.check = check;
      panel.setReplay(data);
      for (const auto* label : panel.findChildren<QLabel*>())
        QVERIFY2(!label->text().contains("0.61") && !label->toolTip().contains("0.61"), qPrintable(label->text()));
      for (const Badge& badge : badgesOf(data)) QVERIFY2(!badge.text.contains("0.61"), qPrintable(badge.text));
    }
  }

  void playbackShowsTheFrameWhoseTimeHasCome();
  void playbackRunsAtItsSpeed_data();
  void playbackRunsAtItsSpeed();
  void playbackStopsAtTheEndAndBeginsAnew();
  void playbackLoopsByTheRemainder();
  void playbackStepsStayInside();
  void playbackOfNothingStaysOff();
  void framesFollowTheTraceByKinematics();
  void framesOfAFixedRobotStandWhereItIsBolted();
  void framesRefuseATraceWithoutTime();
  void badgeTellsTheThreeStates();
  void aBadgeSaysThatARobotHasNoShapes();
  void badgeShowsEnoughDigitsToTellFitnessesApart();
  void panelStartsAtTheFirstFrameAndScrubs();
  void panelKeysPlayStepAndJump();
  void panelPlaysAtTheChosenSpeed();
  void panelShowsFitnessSimulatorAndStandIn();
  void panelShowsGhostsAtTheSameTime();
  void panelSaysWhatIsWrongWithATrace();
  void panelWorksWithoutOpenGl();
  void playingMovesTheBallInThePicture();
  void jobDeliversOnTheCallersThread();
  void jobReportsAnException();
  void jobRunsOneAtATimeAndAnswersTheLast();
  void jobCancelsOnDestruction();
  void panelFollowsAJob();
};

void TestReplayPanel::playbackShowsTheFrameWhoseTimeHasCome() {
  Playback playback;
  playback.setTimes(everyEightMilliseconds(100));
  playback.setPlaying(true);
  playback.advance(0.0079);
  QCOMPARE(playback.frame(), std::size_t(0));
  playback.advance(0.0002);
  QCOMPARE(playback.frame(), std::size_t(1));
  // Recordings need not be uniform.
  playback.setTimes({0.0, 0.5, 0.6, 2.0});
  playback.setPlaying(true);
  playback.advance(0.55);
  QCOMPARE(playback.frame(), std::size_t(1));
  playback.advance(1.0);
  QCOMPARE(playback.frame(), std::size_t(2));
}

void TestReplayPanel::playbackRunsAtItsSpeed_data() {
  QTest::addColumn<double>("speed");
  for (double speed : ReplayPanel::speeds()) QTest::newRow(qPrintable(QString::number(speed))) << speed;
}

void TestReplayPanel::playbackRunsAtItsSpeed() {
  QFETCH(double, speed);
  Playback playback;
  playback.setTimes(everyEightMilliseconds(1001));
  playback.setSpeed(speed);
  playback.setPlaying(true);
  for (int i = 0; i < 100; ++i) playback.advance(0.016);
  QVERIFY(std::abs(playback.position() - 1.6 * speed) < 1e-9);
  QVERIFY(std::abs(playback.timeOf(playback.frame()) - playback.position()) <= kPeriod);
  QVERIFY(playback.timeOf(playback.frame()) <= playback.position());
}

void TestReplayPanel::playbackStopsAtTheEndAndBeginsAnew() {
  Playback playback;
  playback.setTimes({1.0, 1.5, 2.0});
  playback.setPlaying(true);
  playback.advance(5);
  QVERIFY(!playback.playing());
  QCOMPARE(playback.frame(), std::size_t(2));
  QCOMPARE(playback.position(), 2.0);
  playback.setPlaying(true);
  QCOMPARE(playback.position(), 1.0);
}

void TestReplayPanel::playbackLoopsByTheRemainder() {
  Playback playback;
  playback.setTimes({1.0, 1.5, 2.0});
  playback.setLooping(true);
  playback.setPlaying(true);
  playback.advance(2.75);
  QVERIFY(playback.playing());
  QVERIFY(std::abs(playback.position() - 1.75) < 1e-12);
  QCOMPARE(playback.frame(), std::size_t(1));
}

void TestReplayPanel::playbackStepsStayInside() {
  Playback playback;
  playback.setTimes({0.0, 0.1, 0.2});
  playback.setPlaying(true);
  playback.step(1);
  QVERIFY(!playback.playing());
  QCOMPARE(playback.frame(), std::size_t(1));
  QCOMPARE(playback.position(), 0.1);
  playback.step(-5);
  QCOMPARE(playback.frame(), std::size_t(0));
  playback.step(7);
  QCOMPARE(playback.frame(), std::size_t(2));
  playback.showTime(0.15);
  QCOMPARE(playback.frame(), std::size_t(1));
}

void TestReplayPanel::playbackOfNothingStaysOff() {
  Playback playback;
  playback.setPlaying(true);
  playback.advance(1);
  playback.step(1);
  QVERIFY(!playback.playing());
  QCOMPARE(playback.frames(), std::size_t(0));
  QCOMPARE(playback.position(), 0.0);
}

void TestReplayPanel::framesFollowTheTraceByKinematics() {
  const ReplayFrames frames(someReplay());
  QCOMPARE(frames.times().size(), std::size_t(251));
  const ScenePose pose = frames.pose(50);
  QCOMPARE(pose.links.size(), std::size_t(3));
  // Base at (0.05, 0, 0.2), looking along y. The arm starts 0.1 m ahead of it and is raised by 0.5 rad.
  QVERIFY((pose.links[0].translation() - Vector3d(0.05, 0, 0.2)).norm() < 1e-12);
  QVERIFY((pose.links[1].translation() - Vector3d(0.05, 0.1, 0.2)).norm() < 1e-12);
  // The hand: 0.1 m along the arm, then 5 mm along the arm's own z.
  const double c = std::cos(0.5), s = std::sin(0.5);
  const Vector3d hand(0.05, 0.1 + 0.1 * c - 0.005 * s, 0.2 + 0.1 * s + 0.005 * c);
  QVERIFY((pose.links[2].translation() - hand).norm() < 1e-12);
  // The ball: y grows by 2 mm a frame, turned by 90° about x.
  QVERIFY((pose.balls[0].translation() - Vector3d(0.3, 0.1, 0.0425)).norm() < 1e-12);
  QVERIFY((pose.balls[0].linear() * Vector3d::UnitY() - Vector3d::UnitZ()).norm() < 1e-12);
}

void TestReplayPanel::framesOfAFixedRobotStandWhereItIsBolted() {
  ReplayData data = someReplay(2);
  for (std::string& channel : data.trace.channels)
    if (channel.starts_with("small.base.") || channel.starts_with("ball.")) channel = "unknown." + channel;
  data.fixedBase = Isometry3d(Eigen::Translation3d(1, 2, 3));
  const ReplayFrames frames(data);
  QVERIFY((frames.pose(1).links[0].translation() - Vector3d(1, 2, 3)).norm() < 1e-12);
  QVERIFY(frames.ballRadii().empty());
  QVERIFY(frames.pose(1).balls.empty());
}

void TestReplayPanel::framesRefuseATraceWithoutTime() {
  ReplayData data = someReplay(3);
  data.trace.channels[0] = "clock";
  QVERIFY_THROWS_EXCEPTION(InputError, ReplayFrames{data});
  data = someReplay(3);
  data.trace.values[2 * data.trace.channels.size()] = 0.001;  // before the row above
  QVERIFY_THROWS_EXCEPTION(InputError, ReplayFrames{data});
}

void TestReplayPanel::badgeTellsTheThreeStates() {
  ReplayData data = titled("x");
  QCOMPARE(checkBadge(data).tone, Badge::Tone::neutral);
  QVERIFY(checkBadge(data).text.startsWith("not checked"));
  data.check = ReplayData::Check::identical;
  QCOMPARE(checkBadge(data).tone, Badge::Tone::good);
  QCOMPARE(checkBadge(data).text, QString("identical to the stored run"));
  data.check = ReplayData::Check::differs;
  data.storedFitness = 1.25;
  data.fitness = 1.5;
  data.fitnessUnit = "m";
  QCOMPARE(checkBadge(data).tone, Badge::Tone::bad);
  QCOMPARE(checkBadge(data).text, QString("differs from the stored run: stored 1.25 m, now 1.5 m"));
}

// An empty view looks broken.
void TestReplayPanel::aBadgeSaysThatARobotHasNoShapes() {
  ReplayData data = titled("x");
  data.model = test::smallRobot();
  QCOMPARE(badgesOf(data).size(), 1);
  RobotModel bare = *test::smallRobot();
  for (Link& link : bare.links) link.shapes.clear();
  data.model = std::make_shared<RobotModel>(bare);
  QCOMPARE(badgesOf(data).size(), 2);
  QCOMPARE(badgesOf(data)[1].text, QString("the robot's model has no shapes to draw"));
  data.model = nullptr;  // balls only
  QCOMPARE(badgesOf(data).size(), 1);
}

void TestReplayPanel::badgeShowsEnoughDigitsToTellFitnessesApart() {
  ReplayData data = titled("x");
  data.check = ReplayData::Check::differs;
  data.storedFitness = 1.25;
  data.fitness = 1.2500001;
  QCOMPARE(checkBadge(data).text, QString("differs from the stored run: stored 1.25, now 1.2500001"));
  data.fitness = data.storedFitness;
  QCOMPARE(checkBadge(data).text, QString("differs from the stored run: fitness 1.25 in both, motion differs"));
}

void TestReplayPanel::panelStartsAtTheFirstFrameAndScrubs() {
  ReplayPanel panel;
  panel.resize(500, 400);
  QSignalSpy times(&panel, &ReplayPanel::timeChanged);
  panel.setReplay(someReplay());
  auto* slider = named<QSlider>(panel, "Frame of the replay");
  auto* label = named<QLabel>(panel, "Time of the replay in s");
  QCOMPARE(slider->maximum(), 250);
  QCOMPARE(slider->value(), 0);
  QCOMPARE(label->text(), QString("0.000 / 2.000 s"));
  slider->setValue(125);
  QCOMPARE(panel.playback().frame(), std::size_t(125));
  QCOMPARE(label->text(), QString("1.000 / 2.000 s"));
  QCOMPARE(times.last().first().toDouble(), 1.0);
}

void TestReplayPanel::panelKeysPlayStepAndJump() {
  ReplayPanel panel;
  panel.setReplay(someReplay());
  const auto frame = [&] { return int(panel.playback().frame()); };
  // Keys reach the panel through the view, which keeps only its own.
  QTest::keyClick(&panel.view(), Qt::Key_Right);
  QTest::keyClick(&panel.view(), Qt::Key_Right);
  QCOMPARE(frame(), 2);
  QTest::keyClick(&panel.view(), Qt::Key_Left);
  QCOMPARE(frame(), 1);
  QTest::keyClick(&panel.view(), Qt::Key_End);
  QCOMPARE(frame(), 250);
  QTest::keyClick(&panel.view(), Qt::Key_Home);
  QCOMPARE(frame(), 0);
  auto* play = named<QToolButton>(panel, "Play");
  QVERIFY(play);
  QTest::keyClick(&panel.view(), Qt::Key_Space);
  QVERIFY(panel.playback().playing());
  QCOMPARE(play->accessibleName(), QString("Pause"));
  QTest::keyClick(&panel.view(), Qt::Key_Space);
  QVERIFY(!panel.playback().playing());
  QTest::keyClick(&panel.view(), Qt::Key_L);
  QVERIFY(panel.playback().looping());
  // Scrubbing stops the playing.
  QTest::mouseClick(play, Qt::LeftButton);
  QVERIFY(panel.playback().playing());
  named<QSlider>(panel, "Frame of the replay")->setValue(10);
  QVERIFY(!panel.playback().playing());
  QCOMPARE(frame(), 10);
}

void TestReplayPanel::panelPlaysAtTheChosenSpeed() {
  ReplayPanel panel;
  panel.setReplay(someReplay());
  auto* speed = named<QComboBox>(panel, "Speed");
  QCOMPARE(speed->currentText(), QString("1×"));
  panel.setSpeed(0.25);
  QCOMPARE(speed->currentText(), QString("0.25×"));
  panel.setPlaying(true);
  panel.advance(0.4);  // 0.1 s of the trial: frame 12 is at 0.096 s
  QCOMPARE(panel.playback().frame(), std::size_t(12));
  panel.setSpeed(4);
  panel.advance(0.1);  // 0.5 s: frame 62 is at 0.496 s
  QCOMPARE(panel.playback().frame(), std::size_t(62));
  panel.advance(10);
  QVERIFY(!panel.playback().playing());
  QCOMPARE(panel.playback().frame(), std::size_t(250));
}

void TestReplayPanel::panelShowsFitnessSimulatorAndStandIn() {
  ReplayPanel panel;
  panel.resize(600, 400);
  ReplayData data = someReplay();
  data.check = ReplayData::Check::identical;
  data.fitness = 1.375;
  data.simulator = "simulator 3";
  panel.setReplay(data);
  panel.show();
  QCoreApplication::processEvents();
  const auto* result = dynamic_cast<const CutLabel*>(panel.findChild<QLabel*>("result"));
  QVERIFY(result);
  const QString all = result->whole();
  QVERIFY2(all.contains("fitness " + withUnit(1.375, "m")) && all.contains("simulator 3") &&
               all.contains("kick, individual 7"),
           qPrintable(all));
  // Where it has no room its end is left out, and that is seen.
  panel.resize(panel.width() - result->width() + result->fontMetrics().horizontalAdvance(all) / 2, 400);
  QCoreApplication::processEvents();
  QVERIFY2(result->text().endsWith(QChar(0x2026)), qPrintable(result->text()));
  QVERIFY(result->fontMetrics().horizontalAdvance(result->text()) <= result->width());
  QCOMPARE(result->toolTip(), all);
  // The stand-in's label is part of the picture, also of a saved one.
  const QImage real = panel.view().picture({600, 300});
  data.standIn = true;
  panel.setReplay(data);
  const QImage standIn = panel.view().picture({600, 300});
  QVERIFY(standIn != real);
  QCOMPARE(standIn.copy(0, 150, 600, 150), real.copy(0, 150, 600, 150));
}

void TestReplayPanel::panelShowsGhostsAtTheSameTime() {
  ReplayPanel panel;
  panel.setReplay(someReplay());
  panel.view().setFollow(SceneView::Follow::ball);
  panel.showFrame(100);
  const QImage alone = panel.view().picture({300, 200});
  // The ghost's ball runs a third of a metre ahead, sampled at half the rate.
  GhostReplay ghost{someReplay(126)};
  for (std::size_t row = 0; row < ghost.data.trace.rows(); ++row) {
    double* values = &ghost.data.trace.values[row * ghost.data.trace.channels.size()];
    values[0] = 0.016 * double(row);
    values[10] = 0.3;
    values[11] = 0.004 * double(row) - 0.1;
  }
  panel.setGhosts({ghost});
  const QImage both = panel.view().picture({300, 200});
  const auto pixel = panel.view().camera().project({0.3, 0.1, 0.0425}, both.size());
  QVERIFY(both.pixelColor(pixel->toPoint()) != alone.pixelColor(pixel->toPoint()));
  panel.setGhosts({});
  QCOMPARE(panel.view().picture({300, 200}), alone);
}

void TestReplayPanel::panelSaysWhatIsWrongWithATrace() {
  ReplayPanel panel;
  panel.setReplay(someReplay());
  ReplayData broken = someReplay();
  broken.trace.channels[0] = "clock";
  panel.setReplay(broken);
  QCOMPARE(panel.playback().frames(), std::size_t(0));
  QVERIFY(!named<QSlider>(panel, "Frame of the replay")->isEnabled());
  QTest::keyClick(&panel.view(), Qt::Key_Space);
  QVERIFY(!panel.playback().playing());
}

void TestReplayPanel::panelWorksWithoutOpenGl() {
  ReplayPanel panel(nullptr, noOpenGl);
  panel.resize(500, 400);
  panel.setReplay(someReplay());
  panel.grab();
  QTest::keyClick(&panel.view(), Qt::Key_Right);
  QCOMPARE(panel.playback().frame(), std::size_t(1));
  panel.grab();
}

void TestReplayPanel::playingMovesTheBallInThePicture() {
  ReplayPanel panel;
  panel.setReplay(someReplay());
  const auto orangeAt = [&](const Vector3d& point) {
    const QImage image = panel.view().picture({320, 240});
    const auto pixel = panel.view().camera().project(point, image.size());
    const QColor colour = image.pixelColor(pixel->toPoint());
    return colour.red() > 140 && colour.hsvHue() >= 8 && colour.hsvHue() <= 40 && colour.hsvSaturation() > 110;
  };
  QVERIFY(orangeAt({0.3, 0, 0.0425}));
  panel.setPlaying(true);
  panel.advance(0.8001);  // frame 100: y = 0.2 m
  QCOMPARE(panel.playback().frame(), std::size_t(100));
  QVERIFY(orangeAt({0.3, 0.2, 0.0425}));
  QVERIFY(!orangeAt({0.3, 0, 0.0425}));
}

void TestReplayPanel::jobDeliversOnTheCallersThread() {
  ReplayJob job;
  QSignalSpy finished(&job, &ReplayJob::finished);
  QThread* workedOn = nullptr;
  QThread* heardOn = nullptr;
  QString title;
  connect(&job, &ReplayJob::finished, [&](const ReplayData& data) {
    heardOn = QThread::currentThread();
    title = data.title;
  });
  job.start([&] {
    workedOn = QThread::currentThread();
    return titled("done");
  });
  QVERIFY(job.running());
  QVERIFY(finished.wait());
  QCOMPARE(title, QString("done"));
  QCOMPARE(heardOn, thread());
  QVERIFY(workedOn != thread());
  QVERIFY(!job.running());
}

void TestReplayPanel::jobReportsAnException() {
  ReplayJob job;
  QSignalSpy failed(&job, &ReplayJob::failed), finished(&job, &ReplayJob::finished);
  job.start([]() -> ReplayData { throw InputError("run 3", "individual 99", "1 to 50"); });
  QVERIFY(failed.wait());
  QCOMPARE(failed.first().first().toString(), QString("run 3: individual 99 is not allowed; 1 to 50"));
  QCOMPARE(finished.count(), 0);
}

void TestReplayPanel::jobRunsOneAtATimeAndAnswersTheLast() {
  ReplayJob job;
  QStringList heard;
  connect(&job, &ReplayJob::finished, [&](const ReplayData& data) { heard << data.title; });
  QSignalSpy finished(&job, &ReplayJob::finished);
  std::atomic<int> inside = 0, most = 0, runs = 0;
  QSemaphore gate;
  const auto work = [&](const QString& title) {
    return [&, title] {
      most = std::max(most.load(), ++inside);
      ++runs;
      gate.acquire();
      --inside;
      return titled(title);
    };
  };
  job.start(work("first"));
  job.start(work("second"));
  job.start(work("third"));
  gate.release(3);
  QVERIFY(finished.wait());
  QCOMPARE(heard, QStringList("third"));
  QCOMPARE(most.load(), 1);
  QCOMPARE(runs.load(), 2);  // the second never began
  QVERIFY(!job.running());
}

void TestReplayPanel::jobCancelsOnDestruction() {
  int answers = 0;
  bool sawInterruption = false;
  {
    QSemaphore begun;
    ReplayJob job;
    connect(&job, &ReplayJob::finished, [&] { ++answers; });
    job.start([&] {
      begun.release();
      while (!QThread::currentThread()->isInterruptionRequested()) QThread::yieldCurrentThread();
      sawInterruption = true;
      return ReplayData{};
    });
    begun.acquire();
  }
  QCoreApplication::processEvents();
  QVERIFY(sawInterruption);
  QCOMPARE(answers, 0);
}

void TestReplayPanel::panelFollowsAJob() {
  ReplayPanel panel;
  ReplayJob job;
  panel.attach(job);
  QSignalSpy finished(&job, &ReplayJob::finished), failed(&job, &ReplayJob::failed);
  job.start([] { return someReplay(11); });
  QCOMPARE(panel.playback().frames(), std::size_t(0));
  QVERIFY(finished.wait());
  QCOMPARE(panel.playback().frames(), std::size_t(11));
  job.start([]() -> ReplayData { throw InputError("the database is gone"); });
  QVERIFY(failed.wait());
  QCOMPARE(panel.playback().frames(), std::size_t(0));
}

UI_TEST(TestReplayPanel)
#include "test_replay_panel.moc"
