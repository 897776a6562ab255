#include "ui/controllers/workbench.h"

#include <QDir>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "core/store/network_file.h"

namespace btr::ui {

Workbench::Workbench(std::shared_ptr<const PluginHost> host, const WindowOptions& options, QWidget& window)
    : QObject(&window),
      host_(std::move(host)),
      options_(options),
      window_(window),
      settings_(options.settingsFile),
      launcher_(host_, options.program),
      watcher_(reader_, options.isActive, [this](Id run) { return launcher_.isAlive(run); }) {
  if (!options_.isWritable) options_.isWritable = [](const QString& path) { return QFileInfo(path).isWritable(); };
  if (!options_.networkWarning) options_.networkWarning = btr::networkWarning;
  connect(&reader_, &DatabaseReader::failed, this, &Workbench::report);
  connect(&watcher_, &DatabaseWatcher::failed, this, &Workbench::report);
  connect(&watcher_, &DatabaseWatcher::followedRun, this, &Workbench::show);
  connect(&watcher_, &DatabaseWatcher::followFailed, this, [this](Id run, const QString& why) {
    report(why);
    if (before_ != run) selectRun(std::exchange(before_, 0));
  });
  connect(&watcher_, &DatabaseWatcher::followedRunTold, this, [this] {
    for (const auto& then : std::exchange(whenSelected_, {})) then();
  });
  // Before everybody else, who asks for it here.
  connect(&watcher_, &DatabaseWatcher::runChanged, this, [this](const RunRecord& run, const RunProgress&, bool active) {
    run_ = run;
    runActive_ = active;
  });
}

QString Workbench::networkWarning() const {
  return QString::fromStdString(options_.networkWarning(path().toStdString()).value_or(""));
}

bool Workbench::mayMake(const QString& path) {
  QMessageBox box(&window_);
  box.setObjectName("makeDatabase");
  box.setIcon(QMessageBox::Question);
  box.setWindowTitle(tr("No such database"));
  box.setTextFormat(Qt::PlainText);
  box.setText(tr("There is no database %1.").arg(QDir::toNativeSeparators(path)));
  box.setInformativeText(tr("A new, empty one can be made there."));
  auto* make = box.addButton(tr("Make a new database"), QMessageBox::AcceptRole);
  auto* cancel = box.addButton(QMessageBox::Cancel);
  make->setObjectName("make");
  cancel->setObjectName("cancel");
  box.setDefaultButton(cancel);
  box.exec();
  return box.clickedButton() == make;
}

bool Workbench::open(const QString& path, Absent absent) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  if (absent == Absent::ask && !QFileInfo::exists(absolute) && !mayMake(absolute)) return false;
  emit databaseLeft();
  const bool opened = guard([&] {
    // A file that may only be read is opened so.
    const bool readOnly = QFileInfo::exists(absolute) && !options_.isWritable(absolute);
    writer_ = watcher_.open(absolute, namesIn(absolute), readOnly ? Database::Mode::readOnly : Database::Mode::create);
    readOnly_ = readOnly;
  });
  if (!opened) return false;
  settings_.addRecentDatabase(absolute);
  whenSelected_.clear();
  run_ = {};
  emit databaseOpened();

  // The run that was looked at last, else the newest.
  const std::vector<RunRecord>& runs = watcher_.runs();
  const Id wanted = settings_.selectedRun(absolute);
  const bool known = std::ranges::any_of(runs, [&](const auto& run) { return run.id == wanted; });
  selectRun(known ? wanted : runs.empty() ? 0 : runs.back().id);
  return true;
}

DatabaseWatcher::Names Workbench::namesIn(const QString& database) const {
  DatabaseWatcher::Names names;
  for (const auto& [experiment, name] : settings_.experimentNames(database)) names[experiment] = name.toStdString();
  return names;
}

void Workbench::nameExperiment(Id experiment, const QString& name) {
  settings_.setExperimentName(path(), experiment, name);
  watcher_.setNames(namesIn(path()));
}

QString Workbench::nameOfExperiment(Id experiment) const {
  const std::vector<ExperimentRecord> all = watcher_.experiments();
  const auto known = std::ranges::find(all, experiment, &ExperimentRecord::id);
  return known == all.end() ? QString() : QString::fromStdString(known->name);
}

Database& Workbench::writer() {
  if (!writer_) writer_ = Database::open(watcher_.path().toStdString(), Database::Mode::readWrite);
  return *writer_;
}

void Workbench::selectRun(Id run) {
  if (!watcher_.isOpen() || (run != 0 && watcher_.followed() == run)) return;
  whenSelected_.clear();
  before_ = watcher_.followed();
  if (run != 0) settings_.setSelectedRun(path(), run);
  watcher_.follow(run);
  if (run == 0) show({});
}

void Workbench::whenSelected(std::function<void()> then) {
  if (watcher_.followed() == run_.id) return then();
  whenSelected_.push_back(std::move(then));
}

// An experiment may name folders of plugins.
void Workbench::loadPluginsOf(const RunRecord& run) {
  const std::string place = "run " + std::to_string(run.id);
  const ExperimentSpec spec = experimentFromJson(run.specJson, place, "");
  if (!spec.plugins.empty()) host_->load(spec.plugins, place + " /plugins");
}

// Before the rest of its news is told.
void Workbench::show(const RunRecord& run) {
  emit runLeft();
  run_ = run;
  runActive_ = false;
  if (run.id != 0) guard([&] { loadPluginsOf(run); });
  guard([&] { emit runSelected(run); });
}

// What btr says begins with its name, which is for a terminal.
void Workbench::report(const QString& error) {
  static const QString speaker = QStringLiteral("btr: ");
  lastError_ = error.startsWith(speaker) ? error.mid(speaker.size()) : error;
  emit reported(lastError_);
}

void Workbench::mend(const QString& error) {
  if (!error.isEmpty()) emit mended(error);
}

bool Workbench::guard(const std::function<void()>& action) {
  try {
    action();
    return true;
  } catch (const std::exception& error) {
    report(QString::fromUtf8(error.what()));
    return false;
  }
}

}  // namespace btr::ui
