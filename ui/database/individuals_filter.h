#pragma once
#include <QSortFilterProxyModel>
#include <unordered_set>

#include "ui/database/individuals_model.h"

namespace btr::ui {

/// Sorts and filters the individuals. Compares the records themselves, so that large runs sort at once. What is missing
/// in a column (no measurement) comes last in both directions.
class IndividualsFilter : public QSortFilterProxyModel {
  Q_OBJECT

 public:
  explicit IndividualsFilter(IndividualsModel& model, QObject* parent = nullptr);

  /// Whole generations from … to; 0 leaves that end open.
  void setGenerations(int from, int to);
  void setMeasuredOnly(bool on);
  /// Each chromosome once: where it was best, of equal ones the earliest. Same rule as the list of those to measure.
  void setBestDistinct(bool on);
  /// Words that all must be found in outcome, detail or chromosome (a beginning of it); without case.
  void setWords(const QString& words);

  const IndividualRecord& recordAt(const QModelIndex& proxyIndex) const;

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  void findBest();

  IndividualsModel& model_;
  int from_ = 0, to_ = 0;
  bool measuredOnly_ = false, bestDistinct_ = false;
  QStringList words_;
  std::unordered_set<Id> best_;
};

}  // namespace btr::ui
