#pragma once
#include <QWidget>
#include <map>
#include <set>
#include <vector>

#include "core/store/records.h"

class QComboBox;
class QLineEdit;
class QMenu;
class QModelIndex;
class QStandardItem;
class QStandardItemModel;
class QToolButton;
class QTreeView;

namespace btr::ui {

/// The runs of a grid's cells, which stand together under their experiment.
struct RunGroup {
  Id grid = 0;
  QString name;
  std::map<Id, int> cells;  ///< the number of the cell, by its run
};

/// Experiments, their runs, and the runs' simulator versions. Keeps selection and folding when the content changes;
/// asks for what the user wants by signals and does nothing itself.
class ExperimentTree : public QWidget {
  Q_OBJECT
 public:
  explicit ExperimentTree(QWidget* parent = nullptr);

  void setContent(const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs,
                  const std::vector<RunGroup>& groups = {});
  void setSimulators(Id run, const std::vector<SimulatorRecord>& simulators);
  /// The versions of all rigs: experiments of the content whose simulators stand directly below them.
  void setRigs(const std::vector<SimulatorRecord>& versions);
  void setActive(const std::set<Id>& active);
  /// Selects the run without telling runSelected() again if it already is.
  void selectRun(Id run);
  Id selectedRun() const;  ///< of the selected run or its simulator version, else 0
  Id selectedRig() const;  ///< of the selected rig or its simulator version, else 0
  /// What can be done with a run, as a menu with the entries that make sense now.
  void fillRunMenu(QMenu& menu, Id run);
  /// What can be done with all that is selected.
  void fillMenu(QMenu& menu);
  QTreeView* view() const { return view_; }
  /// Experiments that are put away: seen only while the archive is shown.
  void setArchived(const std::set<Id>& experiments);

 signals:
  void runSelected(btr::Id run);
  void simulatorSelected(btr::Id run, btr::Id simulator);
  void rigSelected(btr::Id rig, btr::Id simulator);  ///< simulator 0: the rig itself
  void continueRequested(btr::Id run);
  void stopRequested(btr::Id run);
  void duplicateRequested(btr::Id run);
  void specRequested(btr::Id run);
  void runNoteRequested(btr::Id run);
  void experimentNoteRequested(btr::Id experiment);
  void renameRequested(btr::Id experiment);
  void archivedChanged(const std::set<btr::Id>& experiments);
  void exportRequested(btr::Id run, const QString& what);
  void compareRequested(const std::vector<btr::Id>& runs);
  void gridRequested(btr::Id grid);

 private:
  enum Kind { experimentKind = 1, runKind, simulatorKind, groupKind };
  QStandardItem* child(QStandardItem& parent, Kind kind, Id id);
  QStandardItem* showSimulator(QStandardItem& parent, const SimulatorRecord& simulator, const QString& detail);
  void showRun(QStandardItem& item, const RunRecord& run);
  void showGroup(QStandardItem& item, const RunGroup& group);
  void keepOnly(QStandardItem& parent, Kind kind, const std::set<Id>& ids);
  void openMenu(const QPoint& position);
  std::vector<Id> runsOf(Id experiment) const;
  std::vector<Id> chosen(Kind kind) const;  ///< those of the selection
  void fillRunsMenu(QMenu& menu, const std::vector<Id>& runs);
  void fillExperimentsMenu(QMenu& menu, const std::vector<Id>& experiments);
  void archive(const std::vector<Id>& experiments, bool away);
  QWidget* makeBar();
  void nameExperiments(const std::vector<ExperimentRecord>& experiments);
  void sort();
  void filter();
  bool filterChildren(const QStandardItem& parent, const QString& wanted);
  void current(const QModelIndex& index);
  void activate(const QModelIndex& index);

  QTreeView* view_;
  QLineEdit* search_;
  QComboBox* order_;
  QToolButton* archive_;
  QStandardItemModel* model_;
  std::map<Id, RunRecord> runs_;
  std::map<Id, QStandardItem*> runItems_;
  std::map<Id, std::pair<QStandardItem*, QString>> shown_;  ///< of each run, what its item shows
  std::set<Id> rigs_, archived_;
  std::map<Id, int> cells_;  ///< of grids, by their runs
  std::set<Id> active_;
  bool quiet_ = false;  ///< while the program itself changes the selection
};

}  // namespace btr::ui
