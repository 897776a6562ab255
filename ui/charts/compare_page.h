#pragma once
#include <QWidget>
#include <map>
#include <set>

#include "core/run/comparison.h"
#include "ui/charts/fitness_plot.h"
#include "ui/charts/spec_difference.h"

class QCheckBox;
class QLabel;
class QSplitter;
class QTabWidget;
class QTableWidget;
class QTimer;
class QTreeWidget;
class QTreeWidgetItem;

namespace btr::ui {

class PlotWidget;

/// Several runs side by side: charts of their fitness, and by measurement stage of the reality gap and of real fitness;
/// runs that differ only in their seed as mean and 95 % interval; tables of what they reached and of the settings that
/// differ. Charts hold
/// one unit of fitness: of the first chosen run; runs with another one are left out of them, and named.
class ComparePage : public QWidget {
  Q_OBJECT

 public:
  /// Generations of a run (without individuals), its simulator versions and what its measurement stages showed.
  struct History {
    std::vector<GenerationRecord> generations;
    std::vector<SimulatorRecord> simulators;
    std::vector<StageOutcome> stages = {};
    QString unit = {};  ///< of its fitness
  };

  explicit ComparePage(QWidget* parent = nullptr);

  /// All runs to choose from, with their specs; the names of their experiments by id. Ticks stay. What is known of runs
  /// that went on since is no longer taken for fresh.
  void setRuns(const std::vector<RunRecord>& runs, const std::map<Id, QString>& experiments);
  void setChosen(const std::vector<Id>& runs);
  std::vector<Id> chosen() const;
  /// Asks for the chosen runs again, for those that are still learning. What is there stays until it comes.
  void refresh();
  /// The same of those that are not fresh.
  void readOn() { ask(); }
  /// Answers to what was wanted; `trouble` is shown: why others cannot be read.
  void setHistories(std::map<Id, History> histories, const QString& trouble = {});
  /// Another database: numbers of runs mean others now.
  void forget();

  PlotWidget& plot() { return *plot_; }
  PlotWidget& stages() { return *stages_; }     ///< the gap by stage
  PlotWidget& realFitness() { return *real_; }  ///< the same of real fitness
  QTableWidget& reached() { return *reached_; }
  /// Brings the chart of the measurement stages to the front, or that of fitness.
  void showStages(bool on);
  QTableWidget& differences() { return *differences_; }

 signals:
  /// The chosen runs that are not known, or no longer; answered by setHistories().
  void wanted(const std::vector<btr::Id>& runs);

 protected:
  /// The list stands beside the charts, or above them where both have no room side by side.
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange(Qt::Orientation orientation);
  QWidget* makeOptions();
  void ask();
  QString experimentOf(const RunRecord& run) const;
  void listRuns();
  void showGenerations();
  QString nameOf(const RunRecord& run) const;
  void draw();
  void fillReached(const std::vector<ComparedArm>& arms, const QString& unit);
  void fillDifferences(const std::vector<RunRecord>& runs);

  QSplitter* parts_;  ///< the list of runs, and all that is shown of them
  QTreeWidget* tree_;
  QTimer* ticked_;  ///< runs out when all ticks of one click are set
  PlotWidget *plot_, *stages_, *real_;
  QTabWidget* charts_;
  QTableWidget *differences_, *reached_;
  QLabel *summary_, *leftOut_;
  QCheckBox *joinSeeds_, *onlyDifferent_;
  std::vector<RunRecord> runs_;
  std::map<Id, QString> experiments_;
  std::map<Id, History> read_;
  std::set<Id> fresh_;    ///< of these: read since the last refresh()
  QStringList listed_;    ///< what the tree shows of the runs that does not change while they learn
  QStringList compared_;  ///< what the table of settings shows
  QString differ_;        ///< how many of them differ
  QString trouble_;
};

}  // namespace btr::ui
