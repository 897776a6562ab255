#pragma once
#include <QAbstractTableModel>
#include <map>
#include <set>
#include <unordered_map>

#include "core/run/reality/spread.h"
#include "core/store/records.h"

namespace btr::ui {

/// The individuals of a run as a table. Holds the records by value; further ones are appended page by page, so that
/// tens of thousands of rows never stop the window.
class IndividualsModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column {
    number,
    generation,
    slot,
    fitness,
    outcome,
    simulator,
    sameAs,
    measuredMean,
    measuredDeviation,
    measuredCount,
    voidCount,
    columns
  };
  /// The bare value of a cell, for sorting: a number, or the outcome's text; without a measurement nothing.
  static constexpr int SortRole = Qt::UserRole;

  explicit IndividualsModel(QObject* parent = nullptr);

  void setUnit(const QString& unit);
  void setStandIn(bool standIn);
  /// Give the version numbers behind the simulators' ids.
  void setSimulators(const std::vector<SimulatorRecord>& simulators);
  void setMeasurements(const std::vector<MeasurementRecord>& measurements);
  /// Individuals whose simulated fitness nobody shall know yet: they wait to be measured.
  void setHidden(const std::set<Id>& hidden);
  const std::set<Id>& hidden() const { return hidden_; }
  bool isHidden(const IndividualRecord& individual) const {
    return hidden_.contains(individual.id) || hidden_.contains(individual.sameAs);
  }
  void clear();
  /// Those that are there already (by id) are skipped.
  void append(const std::vector<IndividualRecord>& individuals);

  const IndividualRecord& at(int row) const { return individuals_[static_cast<std::size_t>(row)]; }
  /// -1 if it is not there.
  int rowOf(Id individual) const;
  /// Real fitness without void values; nullptr if none was entered.
  const Spread* measuredAt(int row) const;
  bool isStandIn() const { return standIn_; }
  QString unit() const { return unit_; }
  int simulatorNumber(Id id) const;  ///< -1 if not known

  /// Column titles for CSV, a unit at the end of those that carry one.
  static QStringList csvColumns(const QString& unit);
  /// Lines for these rows under csvColumns(), numbers exact; says who measured ("person" or "stand_in").
  QString toCsv(const std::vector<int>& rows) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

 private:
  struct Measured {
    std::vector<double> values;
    Spread spread;
    int voids = 0;
  };
  QVariant valueAt(int row, int column) const;
  QVariant textAt(int row, int column) const;
  const Measured* measured(int row) const;

  std::vector<IndividualRecord> individuals_;
  std::unordered_map<Id, int> rows_;
  std::unordered_map<Id, Measured> measured_;
  std::map<Id, int> simulators_;
  std::set<Id> hidden_;
  QString unit_;
  bool standIn_ = false;
};

}  // namespace btr::ui
