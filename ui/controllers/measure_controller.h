#pragma once
#include <QObject>
#include <set>
#include <vector>

#include "core/run/loop/back_to_reality.h"
#include "ui/controllers/workbench.h"
#include "ui/experiment/run_text.h"

namespace btr::ui {
class Alarm;
class IndividualsTable;
class MeasurementSheet;
class PolicyPage;
class RunController;

/// Measuring: the sheet, the page of L2's policies and the alarm that calls for a person; what a person enters goes to
/// the database here.
class MeasureController : public QObject {
  Q_OBJECT
 public:
  struct Views {
    MeasurementSheet& sheet;
    PolicyPage& policies;
    Alarm& alarm;
    IndividualsTable& individuals;
  };
  MeasureController(Workbench& bench, RunController& runs, const Views& views);
  /// The selected run waits for values that are missing.
  bool isSheetWanted() const { return sheetWanted_; }

 signals:
  void measuringChanged(const btr::ui::MeasuringCount& count);
  /// Measurements of the selected run, with the individuals that they are of.
  void measured(const std::vector<btr::IndividualRecord>& individuals,
                const std::vector<btr::MeasurementRecord>& measurements);
  /// The simulated fitness of those that wait is not to be read anywhere.
  void blindChanged(bool blind);
  void hiddenChanged(const std::set<double>& fitness);  ///< theirs
  void sheetWanted();                                   ///< values have begun to be missing

 private:
  void selectRun(const RunRecord& run);
  void submit(const std::vector<MeasurementRecord>& measurements);
  void voidMeasurement(Id measurement, bool isVoid, const QString& note);
  void importMeasurements();
  QString whereItStands();
  QString parametersCsv(const std::vector<IndividualRecord>& individuals) const;
  void giveParameters(const std::vector<Id>& individuals, bool asFile);
  void showTasks(const std::vector<MeasurementTask>& tasks, const std::vector<MeasurementRecord>& measurements);
  void readMeasured();
  void showStored();
  void keepMeasurements();
  void hideSimulated();
  void showWaiting();
  struct WaitingRun {
    RunRecord run;
    MeasuringCount count;
  };
  void countWaiting(const std::vector<RunRecord>& runs);
  void callForPerson(const std::vector<WaitingRun>& waiting);
  void showPolicies(const RunProgress& progress);
  void endRealityLearning();

  Workbench& bench_;
  RunController& runs_;
  Views views_;
  std::vector<MeasurementTask> tasks_;
  std::vector<MeasurementRecord> measurements_;
  std::vector<Parameter> genotype_;        ///< of the run's controller
  std::vector<std::size_t> policiesSeen_;  ///< what the page of L2 was made from
  QString unit_;
  bool canBeNegative_ = false;  ///< the run's fitness
  QString sheetDatabase_;       ///< that the sheet's run is of
  Id waitingRun_ = 0;           ///< that the alarm leads to
  bool sheetWanted_ = false;
};

}  // namespace btr::ui
