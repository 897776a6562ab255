#pragma once
#include <QObject>
#include <QTimer>
#include <functional>
#include <set>

#include "ui/controllers/workbench.h"
#include "ui/experiment/run_text.h"

namespace btr::ui {
class ProgramProcess;

/// What the user asks of runs: start, continue, stop, duplicate, names and notes, tables, and the runs of another
/// database. Learning happens in processes of their own, whose ends are watched here.
class RunController : public QObject {
  Q_OBJECT
 public:
  explicit RunController(Workbench& bench);

  void setJobs(int jobs) { jobs_ = jobs; }
  int jobs() const { return jobs_; }
  void resume(Id run);  ///< or begin; says what a run that waits is waiting for
  /// All its values were just saved: goes on, also if a process of ours has looked for the last time before.
  void resumeMeasured(Id run);
  void stop(Id run);
  void duplicate(Id run);
  void editRunNote(Id run);
  void editExperimentNote(Id experiment);
  void renameExperiment(Id experiment);
  void exportTable(Id run, const QString& what);
  /// Copies all runs of another database into the one that is open.
  void mergeWithDialog();
  void merge(const QString& from);
  void backUpWithDialog();
  /// Asks what shall become of the runs that are at work. False: the window stays open.
  bool mayClose();

 private:
  const RunRecord* runWith(const RunRecord& like, std::uint64_t seed) const;
  void launch(Id run);
  void checkLaunched();
  void checkMeasured();
  struct Standing {
    RunRecord run;
    MeasuringCount count;
  };
  /// `why` tells requests apart that may be under way at once.
  void readStanding(Id run, const QString& why, const std::function<void(const Standing&)>& then);
  void sayWhatItWaitsFor(const Standing& standing);

  Workbench& bench_;
  int jobs_ = 0;
  std::set<Id> launched_;  ///< processes of ours whose end was not seen yet
  /// Runs whose last value was saved while their process was at work: it may have looked for the last time before.
  std::set<Id> measuredMeanwhile_;
  QTimer processes_;  ///< runs while one of them may end
  ProgramProcess* merging_ = nullptr;
  QString mergedFrom_;
};

}  // namespace btr::ui
