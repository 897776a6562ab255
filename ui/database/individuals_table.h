#pragma once
#include <QTimer>
#include <QWidget>
#include <functional>

#include "ui/database/individuals_filter.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QSpinBox;
class QTableView;

namespace btr::ui {

class IndividualDetails;

/// The page with the individuals of a run: sortable, filterable, with everything about the selected one beside it.
/// It takes values; a run is read page by page through a function, so that the window goes on meanwhile.
class IndividualsTable : public QWidget {
  Q_OBJECT

 public:
  /// Individuals of a generation (1, 2, …); may throw InputError, which ends the reading and is shown.
  using Reader = std::function<std::vector<IndividualRecord>(int generation)>;

  explicit IndividualsTable(QWidget* parent = nullptr);

  void setUnit(const QString& unit);
  void setStandIn(bool standIn);
  void setGenotype(const std::vector<Parameter>& genotype);
  void setSimulators(const std::vector<SimulatorRecord>& simulators);
  void setMeasurements(const std::vector<MeasurementRecord>& measurements);
  /// Individuals whose simulated fitness is not shown.
  void setHidden(const std::set<Id>& hidden);
  /// Empties the table and reads generations 1 … `last`, a few with each turn of the event loop; then loaded().
  void load(int last, Reader read);
  /// One more generation, with its individuals.
  void append(const GenerationRecord& generation);
  void clear();

  /// Shows and selects it; false if it is not in the table (yet) or filtered out.
  bool select(Id individual);
  Id selected() const;  ///< 0 if none
  std::vector<Id> selectedAll() const;
  /// The visible rows as CSV, those selected if more than one is.
  QString csv() const;
  void copyCsv() const;

  IndividualsModel& model() { return model_; }
  IndividualsFilter& filter() { return filter_; }
  QTableView& view() { return *view_; }
  IndividualDetails& details() { return *details_; }

 signals:
  void selectionChanged(btr::Id individual);
  void replayRequested(btr::Id individual);
  /// Both at once, beside each other.
  void pairRequested(btr::Id first, btr::Id second);
  void loaded();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* makeFilterBar();
  void fitColumns();
  void readPage();
  void showCount();
  void showSelected();
  void showMenu(const QPoint& place);
  void exportCsv();

  IndividualsModel model_;
  IndividualsFilter filter_;
  QTableView* view_;
  IndividualDetails* details_;
  QLabel* count_;
  QSpinBox *from_, *to_;
  QCheckBox *measured_, *distinct_;
  QLineEdit* words_;
  Reader read_;
  int next_ = 1, last_ = 0;
  QString trouble_;
  QTimer reading_;
};

}  // namespace btr::ui
