// What the window remembers, and its two looks.
#include <QApplication>
#include <QTemporaryDir>
#include <QTest>

#include "ui/common/look/message_banner.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/settings.h"

using namespace btr::ui;

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
      const auto contrast = [](const QColor& a, const QColor& b) {
        const auto luminance = [](const QColor& c) {
          const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
          return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
        };
        const double x = luminance(a), y = luminance(b);
        return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
      };
      // WCAG AA: 4.5 for text.
      QVERIFY(contrast(palette.color(QPalette::Text), palette.color(QPalette::Base)) >= 4.5);
      QVERIFY(contrast(palette.color(QPalette::ButtonText), palette.color(QPalette::Button)) >= 4.5);
      QVERIFY(contrast(palette.color(QPalette::HighlightedText), palette.color(QPalette::Highlight)) >= 4.5);
      const Tones tones = tonesOf(palette);
      for (const QColor& tone : {tones.good, tones.warning, tones.bad, tones.standIn, tones.muted, tones.accent})
        QVERIFY2(contrast(tone, palette.color(QPalette::Window)) >= 4.3, qPrintable(tone.name()));
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

QTEST_MAIN(TestSettings)
#include "test_settings.moc"
