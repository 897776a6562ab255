// The alarm: seen, heard unless muted, silenced, remembered.
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QtEndian>
#include <algorithm>
#include <cstdlib>

#include "tests/ui/ui_tests.h"
#include "ui/measure/alarm.h"
#include "ui/measure/alarm_sound.h"

using namespace btr::ui;

class TestAlarm : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  int played_ = 0;
  QString file(const char* name) { return folder_.filePath(name); }
  std::function<void()> counter() {
    played_ = 0;
    return [this] { ++played_; };
  }

 private slots:
  void ringsUntilSilencedAndStaysUntilCleared() {
    Alarm alarm(nullptr, file("a.ini"), counter());
    QCOMPARE(alarm.state(), Alarm::State::quiet);
    QVERIFY(alarm.isHidden());
    alarm.raiseAlarm("Run 3 waits for 10 measurements");
    QCOMPARE(alarm.state(), Alarm::State::ringing);
    QVERIFY(!alarm.isHidden());
    QCOMPARE(alarm.message(), QString("Run 3 waits for 10 measurements"));
    QCOMPARE(played_, 1);
    alarm.silence();
    QCOMPARE(alarm.state(), Alarm::State::silenced);
    QVERIFY(!alarm.isHidden());
    alarm.clear();
    QVERIFY(alarm.isHidden());
  }

  void theSameMessageDoesNotRingAgainOnceSilenced() {
    Alarm alarm(nullptr, file("b.ini"), counter());
    alarm.raiseAlarm("one");
    alarm.silence();
    alarm.raiseAlarm("one");
    QCOMPARE(alarm.state(), Alarm::State::silenced);
    QCOMPARE(played_, 1);
    alarm.raiseAlarm("two");
    QCOMPARE(alarm.state(), Alarm::State::ringing);
    QCOMPARE(played_, 2);
  }

  void mutedItIsStillSeenAndRemembersIt() {
    {
      Alarm alarm(nullptr, file("c.ini"), counter());
      alarm.setMuted(true);
      alarm.raiseAlarm("now");
      QCOMPARE(played_, 0);
      QCOMPARE(alarm.state(), Alarm::State::ringing);
    }
    Alarm later(nullptr, file("c.ini"), counter());
    QVERIFY(later.isMuted());
    later.setMuted(false);
    Alarm last(nullptr, file("c.ini"), counter());
    QVERIFY(!last.isMuted());
  }

  void unmutingWhileItRingsIsHeardAtOnce() {
    Alarm alarm(nullptr, file("d.ini"), counter());
    alarm.setMuted(true);
    alarm.raiseAlarm("now");
    alarm.setMuted(false);
    QCOMPARE(played_, 1);
  }

  void theButtonOpensTheSheetAndSilences() {
    Alarm alarm(nullptr, file("e.ini"), counter());
    QSignalSpy asked(&alarm, &Alarm::sheetRequested);
    alarm.raiseAlarm("now");
    for (auto* button : alarm.findChildren<QPushButton*>())
      if (button->text().contains("sheet")) button->click();
    QCOMPARE(asked.count(), 1);
    QCOMPARE(alarm.state(), Alarm::State::silenced);
  }

  void itIsPainted() {
    Alarm alarm(nullptr, file("f.ini"), counter());
    alarm.resize(700, 44);
    alarm.raiseAlarm("now");
    const QImage picture = alarm.grab().toImage();
    QVERIFY(picture.pixelColor(2, 20) != picture.pixelColor(300, 2));
  }

  void theChimeIsAValidWavFileThatEndsInSilence() {
    const QByteArray wav = chimeWav();
    QVERIFY(wav.startsWith("RIFF") && wav.mid(8, 8) == "WAVEfmt " && wav.mid(36, 4) == "data");
    QCOMPARE(qFromLittleEndian<quint32>(wav.constData() + 4), quint32(wav.size() - 8));
    QCOMPARE(qFromLittleEndian<quint32>(wav.constData() + 40), quint32(wav.size() - 44));
    int loudest = 0;
    for (qsizetype i = 44; i < wav.size(); i += 2)
      loudest = std::max(loudest, std::abs(int(qFromLittleEndian<qint16>(wav.constData() + i))));
    QVERIFY(loudest > 10000 && loudest < 32767);
    QVERIFY(std::abs(int(qFromLittleEndian<qint16>(wav.constData() + wav.size() - 2))) < 100);
  }

  void withoutAPlayerNothingFails() {
    const QByteArray path = qgetenv("PATH");
    qputenv("PATH", folder_.path().toUtf8());
    AlarmSound sound;
    sound.play();
    sound.play();
    sound.stop();
    qputenv("PATH", path);
  }
};

UI_TEST(TestAlarm)
#include "test_alarm.moc"
