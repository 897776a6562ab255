#pragma once
#include <QObject>
#include <functional>
#include <memory>
#include <optional>

#include "core/plugin/plugin_host.h"
#include "core/store/database.h"
#include "ui/common/database_watcher.h"
#include "ui/common/settings.h"
#include "ui/experiment/run_launcher.h"

namespace btr::ui {

struct WindowOptions {
  QString settingsFile = {};  ///< empty: the user's own
  QString program = {};       ///< that works on runs; empty: btr beside this executable
  DatabaseWatcher::ActiveTest isActive = isRunActive;
  std::function<bool(const QString&)> isWritable = {};  ///< of a database; empty: as the file system says
};

/// What the controllers share: the database that is open, the selected run, the processes at work, the settings, and
/// how to speak to the user. It shows nothing itself.
class Workbench : public QObject {
  Q_OBJECT
 public:
  /// `window` is the parent, also of dialogs.
  Workbench(std::shared_ptr<const PluginHost> host, const WindowOptions& options, QWidget& window);

  const std::shared_ptr<const PluginHost>& host() const { return host_; }
  Settings& settings() { return settings_; }
  RunLauncher& launcher() { return launcher_; }
  DatabaseWatcher& watcher() { return watcher_; }
  QWidget* window() const { return &window_; }

  enum class Absent { ask, make };
  /// Opens a database and selects the run that was selected last. One that does not exist is made only when the user
  /// says so. False, with a message unless the user declined, keeps the old one.
  bool open(const QString& path, Absent absent);
  bool isReadOnly() const { return readOnly_; }
  QString path() const { return watcher_.path(); }
  /// A name of the user's own for a stored experiment; empty: its own again.
  void nameExperiment(Id experiment, const QString& name);
  QString nameOfExperiment(Id experiment) const;
  /// The connection for the user's own words, opened when it is first needed.
  Database& writer();

  void selectRun(Id run);
  const RunRecord& run() const { return run_; }  ///< the selected one as last seen; id 0: none
  bool isRunActive() const { return runActive_; }

  void report(const QString& error) { emit reported(error); }
  void inform(const QString& text) { emit informed(text); }
  void note(const QString& text) { emit noted(text); }
  /// Runs an action that may throw; false, with a message, if it did.
  bool guard(const std::function<void()>& action);

 signals:
  void reported(const QString& error);
  void informed(const QString& text);  ///< goes by itself
  void noted(const QString& text);     ///< stays until it is closed
  void messagesOver();
  void databaseLeft();
  void databaseOpened();
  void runLeft();
  void runSelected(const btr::RunRecord& run);  ///< with everything; id 0: none
  void dockWanted(const QString& dock);
  void replayWanted(btr::Id individual);

 private:
  DatabaseWatcher::Names namesIn(const QString& database) const;
  bool mayMake(const QString& path);

  std::shared_ptr<const PluginHost> host_;
  WindowOptions options_;
  QWidget& window_;
  Settings settings_;
  RunLauncher launcher_;
  DatabaseWatcher watcher_;
  std::optional<Database> writer_;
  bool readOnly_ = false;
  RunRecord run_;
  bool runActive_ = false;
};

}  // namespace btr::ui
