#pragma once
#include <QObject>
#include <QThread>
#include <functional>
#include <map>
#include <memory>

#include "core/plugin/plugin_host.h"
#include "core/spec/experiment_spec.h"
#include "core/store/records.h"
#include "ui/experiment/detached_program.h"

namespace btr::ui {

/// Starts the programs that work on runs. Learning never runs in the window: "btr run" is started detached and outlives
/// it. Preparing and storing a new run takes a moment (robot models are read) and happens in a thread.
class RunLauncher : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit RunLauncher(std::shared_ptr<const PluginHost> host, const QString& program = {}, QObject* parent = nullptr);
  ~RunLauncher() override;
  QString program() const { return program_; }

  /// Checks and stores a run of this experiment, then tells stored() or failed().
  void store(const QString& database, const ExperimentSpec& spec, quint64 seed, bool again);
  /// The same stored experiment, scene and models once more, with another seed.
  void duplicate(const QString& database, Id run, quint64 seed);
  /// Starts a process that goes on with the run. False, and failed(), if it cannot be started.
  bool work(const QString& database, Id run, int jobs);
  /// Last line that the run's process said, empty if none.
  QString lastWords(Id run) const { return lastWords(nameOf(run)); }
  /// True while the process started by work() lives.
  bool isAlive(Id run) const { return isAlive(nameOf(run)); }
  /// Starts a process that learns all grids of a file, or goes on with a stored one. One at a time. False, and
  /// failed(), if it cannot be started.
  bool learnGrids(const QString& database, const QString& file, int workers);
  bool continueGrid(const QString& database, Id grid, int workers);
  QString lastGridWords() const { return lastWords(grids); }
  bool isGridAlive() const { return isAlive(grids); }
  /// Writes a table of the run; tells exported() or failed().
  void exportCsv(const QString& database, Id run, const QString& what, const QString& file);
  /// Makes a checked copy of the database, in place of a file that is there; tells backedUp() or failed().
  void backUp(const QString& database, const QString& file);
  /// Enters a table of measured fitness (columns individual,value[,note][,void]); tells imported() or failed().
  /// `confirmed`: a person has looked at the values that are far from what is expected.
  void importFitness(const QString& database, Id run, const QString& file, bool confirmed = false);
  /// Makes the simulator of a gap report the newest version of a run or, where `rig` names a scene's file, of that rig;
  /// or the newest one's parent again. Tells simulatorChanged() or failed().
  void adopt(const QString& database, Id run, const QString& rig, const QString& simulator, const QString& report);
  void revert(const QString& database, Id run, const QString& rig);
  /// Keeps recordings in the database with their mappings; tells recordingsKept() or failed().
  /// With the run's experiment or with the rig. `scene` may be empty; a mapping beside it counts for files that have
  /// none of their own.
  void keepRecordings(const QString& database, Id run, const QString& rig, const QStringList& files,
                      const QString& scene);
  /// Reads a robot model; tells modelChecked() or failed().
  void checkModel(const QString& file);
  bool isBusy() const { return thread_ != nullptr; }

 signals:
  void stored(btr::Id run);
  /// Of the run that is being stored: in what it differs from one that it was edited from, and what its robots lack of
  /// their files. A line each.
  void remarked(const QString& remarks);
  void exported(const QString& file);
  void backedUp(const QString& file);
  void imported(const QString& file);
  void simulatorChanged(btr::Id run, const QString& rig);
  void recordingsKept(int files);
  void modelChecked(const QString& file, const QString& text);
  void failed(const QString& message);

 private:
  void runToEnd(const QStringList& arguments, const std::function<void()>& done);
  void runToEnd(const QStringList& arguments, const std::function<void(const QString& output)>& done);
  void inThread(std::function<Id()> task);
  static QString nameOf(Id run) { return QStringLiteral("run-%1").arg(run); }
  bool start(const QString& name, QStringList arguments, const QString& jobsOption, int jobs);
  QString lastWords(const QString& name) const;
  bool isAlive(const QString& name) const;

  std::shared_ptr<const PluginHost> host_;
  QString program_;
  inline static const QString grids = QStringLiteral("grids");
  std::map<QString, DetachedProgram> processes_;
  std::unique_ptr<QThread> thread_;
};

}  // namespace btr::ui
