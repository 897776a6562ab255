#include "ui/live/live_process.h"

#include <QCoreApplication>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"

namespace btr::ui {
namespace {

using nlohmann::json;

LiveRow rowFrom(const json& line) {
  LiveRow row;
  row.values = line.at("row").get<std::vector<double>>();
  row.period = line.at("period").get<long>();
  row.playing = line.at("playing").get<bool>();
  row.realTimeFactor = line.at("real_time_factor").get<double>();
  for (const json& each : line.at("fixed")) {
    const auto n = each.get<std::vector<double>>();
    row.fixed.emplace_back(
        static_cast<std::size_t>(n.at(0)),
        Eigen::Translation3d(n.at(1), n.at(2), n.at(3)) * Eigen::Quaterniond(n.at(4), n.at(5), n.at(6), n.at(7)));
  }
  row.fault = QString::fromStdString(line.value("fault", ""));
  return row;
}

}  // namespace

LiveProcess::LiveProcess(const QString& program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr" : program) {
  connect(&process_, &QProcess::readyReadStandardOutput, this, &LiveProcess::read);
  connect(&process_, &QProcess::readyReadStandardError, this, [this] { words_ += process_.readAllStandardError(); });
  connect(&process_, &QProcess::finished, this, &LiveProcess::finished);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart)
      emit failed(tr("%1 cannot be started: %2").arg(program_, process_.errorString()));
  });
}

LiveProcess::~LiveProcess() {
  process_.disconnect(this);
  end();
}

void LiveProcess::start(const QString& file, const QString& log) {
  {
    const QSignalBlocker quiet(this);  // its end was asked for
    end();
  }
  pending_.clear();
  words_.clear();
  QStringList arguments{"live", file, "--steered"};
  if (!log.isEmpty()) arguments << "--log" << log;
  process_.start(program_, arguments);
}

void LiveProcess::end() {
  ready_ = false;
  if (!isRunning()) return;
  process_.closeWriteChannel();
  constexpr int patience_ms = 1500;
  if (process_.waitForFinished(patience_ms)) return;
  // A controller that hangs.
  process_.kill();
  process_.waitForFinished(patience_ms);
}

void LiveProcess::send(const QByteArray& line) {
  if (ready_) process_.write(line + '\n');
}

void LiveProcess::act(const Act& act) { send(QByteArray::fromStdString(toJson(act).dump())); }
void LiveProcess::play(bool on) { send(on ? R"({"do": "play"})" : R"({"do": "pause"})"); }
void LiveProcess::step(int periods) {
  send(QByteArray::fromStdString(json{{"do", "step"}, {"periods", periods}}.dump()));
}
void LiveProcess::setSpeed(double times) {
  send(QByteArray::fromStdString(json{{"do", "speed"}, {"times", times}}.dump()));
}
void LiveProcess::save(const QString& path) {
  send(QByteArray::fromStdString(json{{"do", "save"}, {"path", path.toStdString()}}.dump()));
}

void LiveProcess::read() {
  pending_ += process_.readAllStandardOutput();
  QByteArray newest;  // of rows one is enough
  qsizetype begin = 0;
  for (qsizetype end; (end = pending_.indexOf('\n', begin)) >= 0; begin = end + 1) {
    const QByteArray line = pending_.mid(begin, end - begin);
    if (line.contains("\"row\":")) {
      newest = line;
      continue;
    }
    if (!newest.isEmpty()) tell(std::exchange(newest, {}));
    tell(line);
  }
  pending_.remove(0, begin);
  if (!newest.isEmpty()) tell(newest);
}

void LiveProcess::tell(const QByteArray& text) {
  try {
    const json line = json::parse(text.constData(), text.constData() + text.size());
    if (line.contains("row")) return emit rowTold(rowFrom(line));
    if (line.contains("refused")) return emit refused(QString::fromStdString(line.at("refused")));
    if (line.contains("saved")) return emit saved(QString::fromStdString(line.at("saved")));
    const Game game = gameFromJson(line.at("game").dump(), "game", line.at("directory").get<std::string>());
    const ModelSet models = loadModels(game.scene);
    ready_ = true;
    emit gameTold(game, models, line.at("channels").get<std::vector<std::string>>());
  } catch (const std::exception& error) {
    emit failed(tr("What btr live told cannot be read: %1").arg(error.what()));
    end();
  }
}

void LiveProcess::finished(int code, QProcess::ExitStatus status) {
  const bool wasReady = std::exchange(ready_, false);
  words_ += process_.readAllStandardError();
  if (status == QProcess::NormalExit && code == 0) return;
  QString why = QString::fromUtf8(words_).trimmed().section('\n', -1);
  if (status == QProcess::CrashExit && wasReady)
    why = tr("The world's process crashed. Its log is kept up to the last act. %1").arg(why);
  else if (why.isEmpty())
    why = tr("The world's process ended (exit code %1).").arg(code);
  emit failed(why);
}

}  // namespace btr::ui
