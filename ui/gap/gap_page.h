#pragma once
#include <QWidget>
#include <memory>

#include "core/gap/gap_report.h"
#include "core/store/records.h"
#include "ui/gap/analysis_process.h"

class QAction;
class QLabel;
class QTabWidget;

namespace btr::ui {
class AnalysisSetup;
class CluesView;
class ReportView;

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
  /// The run that adoption is for; `why` it is not possible now, empty if it is.
  void setRun(const QString& name, const std::vector<SimulatorRecord>& versions, const QString& why);

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
  void adoptRequested(const QString& simulatorFile, const QString& reportFolder);
  void revertRequested();
  /// A place in the shown report was chosen.
  void timeChosen(std::size_t trial, double time_s);
  void reportOpened(const QString& folder);
  void failed(const QString& message);
  void informed(const QString& message);

 private:
  void makeActions();
  void start();
  void refresh();

  QString folder_, blocked_;
  int versions_ = 0;
  AnalysisProcess process_;
  QTabWidget* tabs_;
  AnalysisSetup* setup_;
  ReportView* view_;
  CluesView* clues_;
  QLabel* run_;
  QAction *open_, *export_, *adopt_, *revert_;
};

}  // namespace btr::ui
