// What the window remembers, and its two looks.
#include <QApplication>
#include <QLabel>
#include <QProgressBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/look/section.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/settings.h"

using namespace btr::ui;

/// Of WCAG 2: 1 … 21.
double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& c) {
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

class TestSettings : public QObject {
  Q_OBJECT
 private slots:
  void remembersDatabasesRunsAndLook() {
    QTemporaryDir folder;
    const QString file = folder.filePath("settings.ini");
    QStringList databases;
    for (int i = 0; i < 10; ++i) {
      databases << folder.filePath(QStringLiteral("%1.db").arg(i));
      QFile made(databases.last());
      QVERIFY(made.open(QIODevice::WriteOnly));
    }
    {
      Settings settings(file);
      for (const QString& path : databases) settings.addRecentDatabase(path);
      settings.addRecentDatabase(databases[4]);
      settings.setSelectedRun(databases[1], 17);
      settings.setLook(Look::dark);
      settings.setJobs(3);
    }
    QVERIFY(QFile::remove(databases[9]));
    Settings settings(file);
    QCOMPARE(settings.recentDatabases().first(), databases[4]);
    QCOMPARE(settings.recentDatabases().size(), 7);  // eight are kept, one of them was removed
    QCOMPARE(settings.selectedRun(databases[1]), 17);
    QCOMPARE(settings.selectedRun(databases[2]), 0);
    QVERIFY(settings.look() == Look::dark);
    QCOMPARE(settings.jobs(), 3);
  }

  void bothLooksAreReadable() {
    Theme theme(*qApp);
    for (const Look look : {Look::light, Look::dark}) {
      theme.apply(look);
      QCOMPARE(theme.dark(), look == Look::dark);
      const QPalette palette = QApplication::palette();
      // WCAG AA: 4.5 for text.
      QVERIFY(contrast(palette.color(QPalette::Text), palette.color(QPalette::Base)) >= 4.5);
      QVERIFY(contrast(palette.color(QPalette::ButtonText), palette.color(QPalette::Button)) >= 4.5);
      QVERIFY(contrast(palette.color(QPalette::HighlightedText), palette.color(QPalette::Highlight)) >= 4.5);
      const Tones tones = tonesOf(palette);
      for (const QColor& tone : {tones.good, tones.warning, tones.bad, tones.standIn, tones.muted, tones.accent})
        QVERIFY2(contrast(tone, palette.color(QPalette::Window)) >= 4.3, qPrintable(tone.name()));
    }
  }

  void whatHasAStyleSheetOfItsOwnFollowsTheLook() {
    Theme theme(*qApp);
    theme.apply(Look::light);
    Section section(QStringLiteral("Task"), new QLabel(QStringLiteral("content")));
    section.setOpen(false);
    section.resize(200, 60);
    section.show();
    const auto isReadableIn = [&](Look look) {
      theme.apply(look);
      const QImage header = section.grab().toImage();
      const QColor window = QApplication::palette().color(QPalette::Window);
      double most = 1;
      for (int y = 0; y < header.height() / 2; ++y)
        for (int x = 0; x < header.width(); ++x) most = std::max(most, contrast(header.pixelColor(x, y), window));
      QCOMPARE(header.pixelColor(header.width() - 1, 0), window);
      QVERIFY2(most >= 4.5, qPrintable(nameOf(look) + QStringLiteral(": ") + QString::number(most)));
    };
    // Qt tells widgets of a palette while the application runs.
    QTimer::singleShot(0, [&] {
      for (const Look next : {Look::dark, Look::light}) isReadableIn(next);
      QApplication::quit();
    });
    QApplication::exec();
  }

  void aProgressBarIsFilledToItsShare() {
    Theme theme(*qApp);
    for (const Look look : {Look::light, Look::dark}) {
      theme.apply(look);
      QProgressBar bar;
      bar.setRange(0, 4);
      bar.setTextVisible(false);
      bar.resize(200, 20);
      const auto colourAt = [&](int x) { return bar.grab().toImage().pixelColor(x, 10); };
      const QColor base = QApplication::palette().color(QPalette::Base);
      bar.setValue(0);
      QCOMPARE(colourAt(40), base);
      bar.setValue(1);
      QVERIFY(colourAt(40) != base);
      QCOMPARE(colourAt(60), base);
      bar.setValue(4);
      QCOMPARE(colourAt(190), colourAt(40));
      QVERIFY(colourAt(190) != base);
    }
  }

  void writesNumbersWithUnitsAndDurations() {
    QCOMPARE(shortNumber(0.123456), QString("0.1235"));
    QCOMPARE(shortNumber(-0.5), QString("−0.5"));
    QCOMPARE(degrees(-0.35), QString("−20.1°"));
    QCOMPARE(shortNumber(std::nan("")), QString("–"));
    QCOMPARE(withUnit(1.5, "m"), QStringLiteral("1.5\u202fm"));
    QCOMPARE(duration(-1), QString("–"));
    QCOMPARE(duration(12), QString("12 s"));
    QCOMPARE(duration(125), QString("2 min 05 s"));
    QCOMPARE(duration(7500), QString("2 h 05 min"));
  }

  void aBannerShowsTheNewestMessageUntilItIsClosed() {
    MessageBanner banner;
    banner.showMessage(MessageBanner::Kind::error, "first");
    banner.showMessage(MessageBanner::Kind::warning, "second");
    QVERIFY(banner.isVisible());
    QCOMPARE(banner.text(), QString("second"));
    banner.clear();
    QVERIFY(!banner.isVisible());
  }

  void noIconIsEverBlank() {
    QVERIFY(!themeIcon("document-open").isNull());
    QVERIFY(!themeIcon("no-such-icon-anywhere").isNull());
  }
};

UI_TEST(TestSettings)
#include "test_settings.moc"
