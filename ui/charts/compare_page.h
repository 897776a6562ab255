#pragma once
#include <QWidget>
#include <functional>
#include <map>

#include "core/run/comparison.h"
#include "ui/charts/fitness_plot.h"
#include "ui/charts/spec_difference.h"

class QCheckBox;
class QLabel;
class QTabWidget;
class QTableWidget;
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
  /// Generations of a run (without individuals), its simulator versions and what its measurement stages showed; may
  /// throw InputError, which is shown.
  struct History {
    std::vector<GenerationRecord> generations;
    std::vector<SimulatorRecord> simulators;
    std::vector<StageOutcome> stages = {};
    QString unit = {};  ///< of its fitness
  };
  using Reader = std::function<History(Id run)>;

  explicit ComparePage(QWidget* parent = nullptr);

  void setReader(Reader reader);
  /// All runs to choose from, with their specs; the names of their experiments by id. Ticks stay.
  void setRuns(const std::vector<RunRecord>& runs, const std::map<Id, QString>& experiments);
  void setChosen(const std::vector<Id>& runs);
  std::vector<Id> chosen() const;
  /// Reads the chosen runs again, for those that are still learning.
  void refresh();

  PlotWidget& plot() { return *plot_; }
  PlotWidget& stages() { return *stages_; }     ///< the gap by stage
  PlotWidget& realFitness() { return *real_; }  ///< the same of real fitness
  QTableWidget& reached() { return *reached_; }
  /// Brings the chart of the measurement stages to the front, or that of fitness.
  void showStages(bool on);
  QTableWidget& differences() { return *differences_; }

 private:
  QWidget* makeOptions();
  QString experimentOf(const RunRecord& run) const;
  QString nameOf(const RunRecord& run) const;
  void draw();
  void fillReached(const std::vector<ComparedArm>& arms, const QString& unit);
  void fillDifferences(const std::vector<RunRecord>& runs);

  QTreeWidget* tree_;
  PlotWidget *plot_, *stages_, *real_;
  QTabWidget* charts_;
  QTableWidget *differences_, *reached_;
  QLabel *summary_, *leftOut_;
  QCheckBox *joinSeeds_, *onlyDifferent_;
  Reader reader_;
  std::vector<RunRecord> runs_;
  std::map<Id, QString> experiments_;
  std::map<Id, History> read_;
};

}  // namespace btr::ui
