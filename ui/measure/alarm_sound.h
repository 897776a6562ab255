#pragma once
#include <QByteArray>
#include <QObject>
#include <memory>

class QProcess;
class QTemporaryFile;

namespace btr::ui {

/// A WAV file (16 bit, mono) of a two-tone chime of about 0.8 s that starts and ends in silence.
QByteArray chimeWav();

/// Makes itself heard as well as the machine allows: the desktop's beep, and the chime through the first player program
/// that is there (pw-play, paplay, aplay). Without any of them, or without sound hardware, nothing happens.
class AlarmSound : public QObject {
  Q_OBJECT

 public:
  explicit AlarmSound(QObject* parent = nullptr);
  ~AlarmSound() override;
  void play();
  void stop();

 private:
  QString player_;
  std::unique_ptr<QTemporaryFile> file_;
  QProcess* process_;
};

}  // namespace btr::ui
