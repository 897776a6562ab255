#pragma once
#include <QObject>
#include <functional>
#include <memory>
#include <optional>

#include "core/plugin/plugin_host.h"
#include "core/store/database.h"
#include "ui/common/database/database_watcher.h"
#include "ui/common/settings.h"
#include "ui/experiment/run_launcher.h"

namespace btr::ui {

struct WindowOptions {
  QString settingsFile = {};  ///< empty: the user's own
  QString program = {};       ///< that works on runs; empty: btr beside this executable
  DatabaseWatcher::ActiveTest isActive = isRunActive;
  // Of a database; empty: as the file system says.
  std::function<bool(const QString&)> isWritable = {};
  std::function<std::optional<std::string>(const std::string&)> networkWarning = {};
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
  DatabaseReader& reader() { return reader_; }
  DatabaseWatcher& watcher() { return watcher_; }
  QWidget* window() const { return &window_; }

  enum class Absent { ask, make };
  /// Opens a database and selects the run that was selected last. One that does not exist is made only when the user
  /// says so. False, with a message unless the user declined, keeps the old one.
  bool open(const QString& path, Absent absent);
  bool isReadOnly() const { return readOnly_; }
  /// What is to be said of a database on a network file system; empty: it is on a local one.
  QString networkWarning() const;
  QString path() const { return watcher_.path(); }
  /// A name of the user's own for a stored experiment; empty: its own again.
  void nameExperiment(Id experiment, const QString& name);
  QString nameOfExperiment(Id experiment) const;
  /// The connection for what the user enters, of the window's thread.
  Database& writer();

  /// Shows another run, as soon as everything about it is read: until then all pages, and run(), keep the old one. One
  /// that cannot be read is reported, and the one before stays selected.
  void selectRun(Id run);
  /// Calls `then` when the run that was selected last is shown, which may be now; never if another one is selected
  /// before.
  void whenSelected(std::function<void()> then);
  const RunRecord& run() const { return run_; }  ///< that is shown, as last seen; id 0: none
  bool isRunActive() const { return runActive_; }

  void report(const QString& error);
  const QString& lastError() const { return lastError_; }
  /// What was reported is mended: it is shown no longer. Another message stays.
  void mend(const QString& error);
  void inform(const QString& text) { emit informed(text); }
  void note(const QString& text) { emit noted(text); }
  /// Runs an action that may throw; false, with a message, if it did.
  bool guard(const std::function<void()>& action);

 signals:
  void reported(const QString& error);
  void informed(const QString& text);  ///< goes by itself
  void noted(const QString& text);     ///< stays until it is closed
  void mended(const QString& error);
  void messagesOver();
  void databaseLeft();
  void databaseOpened();
  void runLeft();
  void runSelected(const btr::RunRecord& run);  ///< id 0: none
  void dockWanted(const QString& dock);
  void replayWanted(btr::Id individual);

 private:
  void loadPluginsOf(const RunRecord& run);
  void show(const RunRecord& run);
  DatabaseWatcher::Names namesIn(const QString& database) const;
  bool mayMake(const QString& path);

  std::shared_ptr<const PluginHost> host_;
  WindowOptions options_;
  QWidget& window_;
  Settings settings_;
  RunLauncher launcher_;
  DatabaseReader reader_;
  DatabaseWatcher watcher_;
  std::optional<Database> writer_;
  bool readOnly_ = false;
  QString lastError_;
  RunRecord run_;
  bool runActive_ = false;
  Id before_ = 0;  ///< selected before the one that is being read
  std::vector<std::function<void()>> whenSelected_;
};

}  // namespace btr::ui
