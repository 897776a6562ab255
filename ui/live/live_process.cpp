#include "ui/live/live_process.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/sim/model_losses.h"
#include "core/spec/error.h"
#include "ui/live/drawn/live_lines.h"

namespace btr::ui {
namespace {

using nlohmann::json;

QString wordsOf(const json& value) {
  return QString::fromStdString(value.is_string() ? value.get<std::string>() : value.dump());
}

}  // namespace

LiveProcess::LiveProcess(const QString& program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr" : program) {
  connect(&process_, &QProcess::readyReadStandardOutput, this, &LiveProcess::read);
  connect(&process_, &QProcess::readyReadStandardError, this, [this] { words_ += process_.readAllStandardError(); });
  connect(&process_, &QProcess::finished, this, &LiveProcess::finished);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) fail(tr("%1 cannot be started: %2").arg(program_, process_.errorString()));
  });
}

LiveProcess::~LiveProcess() {
  process_.disconnect(this);
  end();
}

void LiveProcess::start(const QString& file, const QString& log, const QString& replay) {
  {
    const QSignalBlocker quiet(this);  // its end was asked for
    end();
  }
  failed_ = false;
  acts_ = undos_ = undosTold_ = 0;
  grips_.reset();
  losses_.clear();
  pending_.clear();
  words_.clear();
  told_.clear();
  models_.clear();  // their files may have changed
  QStringList arguments{"live"};
  if (!file.isEmpty()) arguments << file;
  arguments << "--steered";
  if (!replay.isEmpty()) arguments << "--replay" << replay;
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

void LiveProcess::act(const Act& act) {
  if (ready_) ++acts_;
  json line = toJson(act);
  if (gestureDepth_ > 0) line["gesture"] = gesture_;
  send(QByteArray::fromStdString(line.dump()));
}

void LiveProcess::beginGesture() {
  if (gestureDepth_++ == 0) ++gesture_;
}
void LiveProcess::endGesture() { gestureDepth_ = std::max(0, gestureDepth_ - 1); }
void LiveProcess::type(const std::string& robot, const QString& line) {
  send(QByteArray::fromStdString(json{{"do", "type"}, {"robot", robot}, {"text", line.toStdString() + "\n"}}.dump()));
}
void LiveProcess::kickOff() {
  if (ready_) ++acts_;
  send(R"({"act": "kick_off"})");
}
void LiveProcess::undo() {
  if (ready_) ++undos_;
  send(R"({"do": "undo"})");
}
void LiveProcess::redo() {
  if (ready_) ++undos_;
  send(R"({"do": "redo"})");
}
void LiveProcess::askGame() { send(R"({"do": "game"})"); }

void LiveProcess::setSignals(const std::vector<std::string>& channels) {
  signals_ = channels;
  sendSignals();
}

void LiveProcess::sendSignals() {
  send(QByteArray::fromStdString(json{{"do", "signals"}, {"channels", signals_}}.dump()));
}
void LiveProcess::play(bool on) { send(on ? R"({"do": "play"})" : R"({"do": "pause"})"); }
void LiveProcess::step(int periods) {
  send(QByteArray::fromStdString(json{{"do", "step"}, {"periods", periods}}.dump()));
}
void LiveProcess::setSpeed(double times) {
  speed_ = times;
  send(QByteArray::fromStdString(json{{"do", "speed"}, {"times", times}}.dump()));
}
void LiveProcess::save(const QString& path, const std::string& view) {
  json line{{"do", "save"}, {"path", path.toStdString()}};
  if (!view.empty()) line["view"] = json::parse(view);
  send(QByteArray::fromStdString(line.dump()));
}

void LiveProcess::saveScene(const QString& path) {
  send(QByteArray::fromStdString(json{{"do", "save_scene"}, {"path", path.toStdString()}}.dump()));
}
void LiveProcess::saveExperiment(const QString& path, const std::string& robot) {
  send(QByteArray::fromStdString(
      json{{"do", "save_experiment"}, {"path", path.toStdString()}, {"robot", robot}}.dump()));
}
void LiveProcess::goTo(long period) {
  send(QByteArray::fromStdString(json{{"do", "go_to"}, {"period", period}}.dump()));
}
void LiveProcess::goOn() { send(R"({"do": "go_on"})"); }

void LiveProcess::setContacts(bool on) {
  contacts_ = on;
  send(QByteArray::fromStdString(json{{"do", "contacts"}, {"on", on}}.dump()));
}

void LiveProcess::read() {
  pending_ += process_.readAllStandardOutput();
  QByteArray newest;  // of rows one is enough
  qsizetype begin = 0;
  for (qsizetype end; (end = pending_.indexOf('\n', begin)) >= 0; begin = end + 1) {
    const QByteArray line = pending_.mid(begin, end - begin);
    const auto has = [&line](const char* key) { return line.contains(key); };
    if (has("\"row\":") && !has("\"samples\":") && !has("\"events\":") && !has("\"console\":") &&
        !has("\"programs\":")) {
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
    if (line.contains("samples")) tellSamples(line);
    if (line.contains("row")) return emit rowTold(liveRowFrom(line));
    if (line.contains("refused")) return emit refused(QString::fromStdString(line.at("refused")));
    if (line.contains("hangs")) return emit hangs(wordsOf(line.at("hangs")));
    if (line.contains("fault")) return;  // why it ends; its last words on standard error say it, too
    if (line.contains("saved")) return emit saved(wordsOf(line.at("saved")), wordsOf(line.value("what", json("game"))));
    if (line.contains("log_lost")) return emit logLost(wordsOf(line.at("log_lost")));
    if (line.contains("log")) return tellLog(line.at("log"));
    if (line.contains("signals")) return void(told_ = line.at("signals").get<std::vector<std::string>>());
    if (line.contains("overlaps")) return emit overlapsTold(line.at("overlaps").get<std::vector<std::string>>());
    if (line.contains("undo")) return emit undoTold(wordsOf(line.at("undo")), wordsOf(line.value("redo", json(""))));
    tellGame(line);
  } catch (const std::exception& error) {
    {
      const QSignalBlocker quiet(this);  // why is said below
      end();
    }
    fail(tr("What btr live told cannot be read: %1").arg(error.what()));
  }
}

void LiveProcess::tellGame(const json& line) {
  const Game game = gameFromJson(line.at("game").dump(), "game", line.at("directory").get<std::string>());
  const ModelSet models = modelsOf(game.scene);
  const bool first = !std::exchange(ready_, true);
  undosTold_ = line.at("undos").get<long>();
  tellGrips(line);
  if (first && !signals_.empty()) sendSignals();
  if (first && contacts_) setContacts(true);
  if (first && speed_ != 1) setSpeed(speed_);
  emit gameTold(game, models, line.at("channels").get<std::vector<std::string>>());
  std::vector<std::string> losses = drawingLosses(game.scene, models);
  std::ranges::move(modelLosses(game.scene, models), std::back_inserter(losses));
  tellLosses(std::move(losses));
}

void LiveProcess::tellLosses(std::vector<std::string> losses) {
  const std::vector<std::string> before = std::exchange(losses_, losses);
  std::erase_if(losses, [&](const std::string& loss) { return std::ranges::find(before, loss) != before.end(); });
  if (!losses.empty()) emit lossesTold(losses);
}

void LiveProcess::tellGrips(const json& line) {
  grips_.reset();
  if (line.at("acts").get<long>() != acts_) return;
  grips_.emplace();
  for (const auto& [robot, joints] : line.at("held").items()) grips_->held[robot] = joints.get<Values>();
  for (const json& pull : line.at("pulls")) {
    const Act act = actFromJson(pull.dump(), "pulls");
    if (const auto* is = std::get_if<PullAct>(&act)) grips_->pulls[is->object] = *is;
  }
}

void LiveProcess::tellLog(const json& line) {
  LiveLog log;
  log.from = line.at("from").get<long>();
  log.until = line.at("until").get<long>();
  log.marks = line.at("marks").get<long>();
  log.goesBack = line.at("goes_back").get<bool>();
  for (const json& act : line.at("acts"))
    log.acts.push_back({act.at(0).get<long>(), act.at(1).get<long>(), wordsOf(act.at(2))});
  emit logTold(log);
}

void LiveProcess::tellSamples(const json& line) {
  LiveSamples samples;
  samples.channels = told_;
  for (const json& sample : line.at("samples")) {
    if (sample.size() != told_.size() + 1) throw std::runtime_error("a sample of other channels");
    samples.periods.push_back(sample.at(0).get<long>());
    for (std::size_t i = 1; i < sample.size(); ++i)
      samples.values.push_back(sample[i].is_number() ? sample[i].get<double>() : std::nan(""));
  }
  if (!samples.periods.empty()) emit sampled(samples);
}

/// A file is read once a session: an object that comes does not stop the window for all robots.
ModelSet LiveProcess::modelsOf(const SceneSpec& scene) {
  if (scene.directory != modelsFrom_) models_.clear();
  modelsFrom_ = scene.directory;
  ModelSet models = loadModels(scene, models_);
  for (const auto& [path, model] : models) models_[path] = model;
  return models;
}

void LiveProcess::finished(int code, QProcess::ExitStatus status) {
  const bool wasReady = std::exchange(ready_, false);
  words_ += process_.readAllStandardError();
  if (status == QProcess::NormalExit && code == 0) return;
  QString why = QString::fromUtf8(words_).trimmed().section('\n', -1);
  if (why.startsWith("btr: ")) why.remove(0, 5);  // its name is for a terminal
  if (status == QProcess::CrashExit && wasReady)
    why = tr("The world's process crashed. Its log is kept up to the last act. %1").arg(why);
  else if (why.isEmpty())
    why = tr("The world's process ended (exit code %1).").arg(code);
  fail(why);
}

void LiveProcess::fail(const QString& why) {
  failed_ = true;
  emit failed(why);
}

}  // namespace btr::ui
