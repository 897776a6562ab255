#include "ui/measure/alarm_sound.h"

#include <QApplication>
#include <QDataStream>
#include <QDir>
#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryFile>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace btr::ui {

QByteArray chimeWav() {
  constexpr int rate = 22050, samples = rate * 8 / 10;
  QByteArray bytes;
  QDataStream out(&bytes, QIODevice::WriteOnly);
  out.setByteOrder(QDataStream::LittleEndian);
  out.writeRawData("RIFF", 4);
  out << quint32(36 + 2 * samples);
  out.writeRawData("WAVEfmt ", 8);
  out << quint32(16) << quint16(1) << quint16(1) << quint32(rate) << quint32(2 * rate) << quint16(2) << quint16(16);
  out.writeRawData("data", 4);
  out << quint32(2 * samples);
  for (int i = 0; i < samples; ++i) {
    // Two notes, a fifth apart, each rising in 10 ms and fading out.
    const double half = samples / 2.0, inNote = std::fmod(i, half) / half;
    const double frequency = i < samples / 2 ? 660 : 990;
    const double envelope = std::min(1.0, inNote * half / (0.01 * rate)) * std::pow(1 - inNote, 1.5);
    const double wave = std::sin(2 * std::numbers::pi * frequency * i / rate);
    out << qint16(std::lround(0.6 * 32767 * envelope * wave));
  }
  return bytes;
}

AlarmSound::AlarmSound(QObject* parent) : QObject(parent), process_(new QProcess(this)) {
  process_->setStandardOutputFile(QProcess::nullDevice());
  process_->setStandardErrorFile(QProcess::nullDevice());
}

AlarmSound::~AlarmSound() { stop(); }

void AlarmSound::play() {
  QApplication::beep();
  if (process_->state() != QProcess::NotRunning) return;
  if (!file_) {
    // Looked for and written once, when the first alarm comes.
    for (const char* name : {"pw-play", "paplay", "aplay"})
      if (player_.isEmpty()) player_ = QStandardPaths::findExecutable(name);
    file_ = std::make_unique<QTemporaryFile>(QDir::tempPath() + "/uchilsim-alarm-XXXXXX.wav");
    if (!file_->open() || file_->write(chimeWav()) < 0 || !file_->flush()) player_.clear();
  }
  if (!player_.isEmpty()) process_->start(player_, {file_->fileName()}, QIODevice::NotOpen);
}

void AlarmSound::stop() {
  if (process_->state() == QProcess::NotRunning) return;
  process_->kill();
  process_->waitForFinished(200);
}

}  // namespace btr::ui
