#pragma once
#include <QWidget>
#include <memory>

#include "core/gap/search/gap_report.h"
#include "core/store/records.h"
#include "ui/gap/analysis_process.h"

class QAction;
class QComboBox;
class QTabWidget;

namespace btr::ui {
class AnalysisSetup;
class CluesView;
class ReportView;

/// Who can take a repaired simulator: a run, or a rig (a scene that no run belongs to).
struct AdoptionTarget {
  QString name;                           ///< "run 3"
  QString rig;                            ///< the scene's file; empty: a run
  std::vector<SimulatorRecord> versions;  ///< none: a rig of which the database has nothing yet
  QString why;                            ///< it takes none now; empty if it does
};

/// The gap analysis page: set up and start an analysis, look through its report, adopt what it found, go back.
/// It reads no database and writes none: adoption is asked for by a signal.
class GapPage : public QWidget {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit GapPage(const QString& program = {}, QWidget* parent = nullptr);

  /// Reads a report's folder. False, with failed(), keeps what was there.
  bool openReport(const QString& folder);
  QString folder() const { return folder_; }
  /// Who can take what the report found. Of two the user chooses; until then it is the one at `first`.
  void setTargets(std::vector<AdoptionTarget> targets, std::size_t first = 0);
  /// Simulators that an analysis may begin with beside the scene as given: of the selected run and the set up rig.
  void setStarts(const std::vector<AdoptionTarget>& owners);

  /// Where the run's measured fitness stands; empty: no run.
  void setMeasured(const QString& database, Id run, int measured);

  CluesView& clues() { return *clues_; }
  AnalysisSetup& setup() { return *setup_; }
  ReportView& view() { return *view_; }
  AnalysisProcess& process() { return process_; }
  QAction* adoptAction() const { return adopt_; }
  QAction* revertAction() const { return revert_; }
  /// Writes the report's page, or the suggested commands, to a file. False, with failed(), if it cannot.
  bool exportTo(const QString& file);
  bool saveNext(const QString& file);

 signals:
  /// `rig`: the scene's file of the rig that takes it; empty: the selected run.
  void adoptRequested(const QString& simulatorFile, const QString& reportFolder, const QString& rig);
  void revertRequested(const QString& rig);
  /// A place in the shown report was chosen.
  void timeChosen(std::size_t trial, double time_s);
  void reportOpened(const QString& folder);
  void failed(const QString& message);
  void mended(const QString& message);  ///< what failed() reported no longer holds
  void informed(const QString& message);

 private:
  void makeActions();
  void forgetFolder();  ///< made for an analysis of which nothing came
  void start();
  bool confirmAdoption();
  void refresh();
  const AdoptionTarget* target() const;  ///< the chosen one

  QString refused_;  ///< why the analysis could not be started
  QString folder_;
  QString made_;  ///< the folder that an analysis was given and that was not there before; empty: none
  std::vector<AdoptionTarget> targets_;
  bool chosen_ = false;  ///< by the user, for this report
  AnalysisProcess process_;
  QTabWidget* tabs_;
  AnalysisSetup* setup_;
  ReportView* view_;
  CluesView* clues_;
  QComboBox* into_;
  QAction *open_, *export_, *adopt_, *revert_;
};

}  // namespace btr::ui
