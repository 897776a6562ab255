#include "ui/controllers/workbench.h"

#include <QDir>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

namespace btr::ui {

Workbench::Workbench(std::shared_ptr<const PluginHost> host, const WindowOptions& options, QWidget& window)
    : QObject(&window),
      host_(std::move(host)),
      options_(options),
      window_(window),
      settings_(options.settingsFile),
      launcher_(host_, options.program),
      // A process of ours counts from its start on: until it holds the run's lock nobody else can tell.
      watcher_([this](const std::string& database, Id run) {
        return launcher_.isAlive(run) || options_.isActive(database, run);
      }) {
  if (!options_.isWritable) options_.isWritable = [](const QString& path) { return QFileInfo(path).isWritable(); };
  connect(&watcher_, &DatabaseWatcher::failed, this, &Workbench::report);
  // Before everybody else, who asks for it here.
  connect(&watcher_, &DatabaseWatcher::runChanged, this, [this](const RunRecord& run, const RunProgress&, bool active) {
    run_ = run;
    runActive_ = active;
  });
}

bool Workbench::mayMake(const QString& path) {
  QMessageBox box(&window_);
  box.setObjectName("makeDatabase");
  box.setIcon(QMessageBox::Question);
  box.setWindowTitle(tr("No such database"));
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
    // Made or brought up to date first: the watcher only reads. A file that may only be read is opened so.
    std::optional<Database> writer;
    const bool readOnly = QFileInfo::exists(absolute) && !options_.isWritable(absolute);
    if (!readOnly) writer = Database::open(absolute.toStdString(), Database::Mode::create);
    watcher_.open(absolute, namesIn(absolute));
    writer_ = std::move(writer);
    readOnly_ = readOnly;
  });
  if (!opened) return false;
  settings_.addRecentDatabase(absolute);
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
  const auto names = settings_.experimentNames(path());
  const auto given = names.find(experiment);
  return given != names.end() ? given->second : QString::fromStdString(watcher_.database().experiment(experiment).name);
}

Database& Workbench::writer() {
  if (!writer_) writer_ = Database::open(watcher_.path().toStdString(), Database::Mode::readWrite);
  return *writer_;
}

void Workbench::selectRun(Id run) {
  if (!watcher_.isOpen() || (run != 0 && run == run_.id && watcher_.followed() == run)) return;
  emit runLeft();
  run_ = {};
  runActive_ = false;
  RunRecord selected;
  if (run != 0) {
    guard([&] { selected = watcher_.database().run(run); });
    settings_.setSelectedRun(path(), run);
  }
  run_ = selected;
  guard([&] { emit runSelected(selected); });
  watcher_.follow(run);
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
