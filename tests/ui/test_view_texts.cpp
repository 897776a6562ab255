// The texts of the 3D view: nothing lies upon anything else, however narrow the view is. And the ball that rolls out.
#include <QtTest>
#include <cmath>

#include "tests/ui/ui_tests.h"
#include "ui/scene3d/ball_roll.h"
#include "ui/scene3d/view_texts.h"

using namespace btr;
using namespace btr::ui;

class TestViewTexts : public QObject {
  Q_OBJECT
 private slots:
  void captionAndBadgesStandApartInEveryWidth() {
    const QFontMetrics metrics{QFont()};
    const QStringList caption{"run 1, generation 150, individual 4493", "t = 1.234 s, 1×"};
    const QList<Badge> badges{{"identical to the stored run", Badge::Tone::good},
                              {"stand-in reality, not a robot", Badge::Tone::standIn}};
    for (const int width : {1200, 600, 400, 250, 160}) {
      const ViewTexts texts = layoutTexts(metrics, {width, 300}, caption, badges);
      QCOMPARE(texts.badges.size(), 2);
      QVERIFY(!texts.badges[0].intersects(texts.badges[1]));
      for (const QRect& badge : texts.badges) {
        QVERIFY2(!badge.intersects(texts.caption), qPrintable(QString::number(width)));
        QVERIFY(badge.left() >= 0 && badge.right() < width);
      }
      QVERIFY(texts.caption.right() < width);
    }
    // Wide: the badges keep the upper corner. Narrow: what does not fit says so.
    QVERIFY(layoutTexts(metrics, {1200, 300}, caption, badges).badges[0].top() <
            layoutTexts(metrics, {250, 300}, caption, badges).badges[0].top());
    QVERIFY(layoutTexts(metrics, {160, 300}, caption, badges).badgeTexts[0].endsWith("…"));
    QCOMPARE(layoutTexts(metrics, {1200, 300}, caption, badges).badgeTexts[0], badges[0].text);
  }

  void aBallRollsOutWithUniformDecelerationToItsRest() {
    Trace trace;
    trace.channels = {"time_s",  "ball.x_m", "ball.y_m", "ball.z_m", "ball.qw",
                      "ball.qx", "ball.qy",  "ball.qz",  "dog.x"};
    // 1 m/s along x: the last two rows are 8 ms apart.
    trace.values = {0.992, 0.292, 0.1, 0.04, 1, 0, 0, 0, 7, 1.0, 0.3, 0.1, 0.04, 1, 0, 0, 0, 7};
    appendRoll(trace, "ball", 0.04, {1.55, 0.1, 0.04});
    // v²/(2a) = 1.25 m: a = 0.4 m/s², 2.5 s.
    QCOMPARE(trace.rows(), std::size_t(2 + 313));
    const auto rowAt = [&](double t) { return static_cast<std::size_t>(std::lround((t - 0.992) / 0.008)); };
    const double t = 1.0 + 0.8;
    QVERIFY(std::abs(trace.at(rowAt(t), 0) - t) < 1e-9);
    QVERIFY(std::abs(trace.at(rowAt(t), 1) - (0.3 + 0.8 - 0.2 * 0.8 * 0.8)) < 1e-9);
    const std::size_t last = trace.rows() - 1;
    QVERIFY(std::abs(trace.at(last, 1) - 1.55) < 1e-9);
    QVERIFY(std::abs(trace.at(last, 2) - 0.1) < 1e-12);
    QCOMPARE(trace.at(last, 8), 7.0);
    // It has turned by way/radius about y, to the right of z × x.
    const double half = 1.25 / 0.04 / 2;
    QVERIFY(std::abs(trace.at(last, 4) - std::cos(half)) < 1e-9);
    QVERIFY(std::abs(trace.at(last, 6) - std::sin(half)) < 1e-9);
  }

  void nothingIsAddedWhereTheBallLiesOrGoesElsewhere() {
    Trace trace;
    trace.channels = {"time_s", "ball.x_m", "ball.y_m"};
    trace.values = {0, 0.2, 0, 0.008, 0.2, 0};
    const Trace before = trace;
    appendRoll(trace, "ball", 0.04, {0.2, 0, 0.04});
    appendRoll(trace, "ball", 0.04, {3, 0, 0.04});  // it does not move
    trace.values[1] = 0.25;
    appendRoll(trace, "ball", 0.04, {3, 0, 0.04});  // it moves away from there
    QCOMPARE(trace.rows(), before.rows());
  }
};

UI_TEST(TestViewTexts)
#include "test_view_texts.moc"
