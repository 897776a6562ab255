#pragma once
#include <QWidget>
#include <functional>

#include "ui/database/individuals_filter.h"

class QCheckBox;
class QLineEdit;
class QSpinBox;
class QTableView;

namespace btr::ui {

class IndividualDetails;
class ShortLabel;

/// The page with the individuals of a run: sortable, filterable, with everything about the selected one beside it.
/// It takes values; a run comes page by page from a function that answers later, so that the window goes on meanwhile.
class IndividualsTable : public QWidget {
  Q_OBJECT

 public:
  struct Page {
    std::vector<IndividualRecord> individuals;
    int next = 1;  ///< the generation that the next page begins with
  };
  using Take = std::function<void(Page)>;
  using Failed = std::function<void(const QString& why)>;
  /// Asks for individuals of the generations from `first` (1, 2, …) on, of at most `last`. Once it has returned, one of
  /// the two is called: with whole generations, at least one, or with what is shown in place of the rest.
  using Reader = std::function<void(int first, int last, Take take, Failed failed)>;

  explicit IndividualsTable(QWidget* parent = nullptr);

  void setUnit(const QString& unit);
  void setStandIn(bool standIn);
  void setGenotype(const std::vector<Parameter>& genotype);
  void setSimulators(const std::vector<SimulatorRecord>& simulators);
  void setMeasurements(const std::vector<MeasurementRecord>& measurements);
  /// Individuals whose simulated fitness is not shown.
  void setHidden(const std::set<Id>& hidden);
  /// Empties the table and reads generations 1 … `last`, a page at a time; then loaded().
  void load(int last, Reader read);
  /// There are more generations by now.
  void extend(int last);
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
  void takePage(const Page& page);
  void end(const QString& trouble);
  void showCount();
  void showSelected();
  void showMenu(const QPoint& place);
  void exportCsv();

  IndividualsModel model_;
  IndividualsFilter filter_;
  QTableView* view_;
  IndividualDetails* details_;
  ShortLabel* count_;
  QSpinBox *from_, *to_;
  QCheckBox *measured_, *distinct_;
  QLineEdit* words_;
  Reader read_;
  int next_ = 1, last_ = 0;
  int load_ = 0;  ///< number of the load that is under way: a page of an earlier one comes too late
  bool reading_ = false;
  QString trouble_;
};

}  // namespace btr::ui
