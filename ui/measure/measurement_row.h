#pragma once
#include <QString>
#include <vector>

#include "core/store/records.h"

namespace btr::ui {

/// What a person has typed for one individual and not saved yet.
struct MeasurementEdit {
  std::vector<QString> texts;  ///< repeats that follow the saved ones; "" where nothing stands
  bool isVoid = false;         ///< it fell or cannot be measured
  QString note;
  bool operator==(const MeasurementEdit&) const = default;
  bool isEmpty() const;
};

/// One individual of the sheet: its task, its stored values, its unsaved edit.
struct MeasurementRow {
  enum class State { open, begun, measured, isVoid };

  MeasurementTask task;
  std::vector<MeasurementRecord> saved;  ///< in the order in which they were entered
  MeasurementEdit edit;
  int awaited = 0;  ///< values that were submitted and are not among `saved` yet

  /// An individual is done once as many values as wanted are stored, void ones too: measured, or void if all of them
  /// are.
  State state() const;
  bool isDone() const { return state() == State::measured || state() == State::isVoid; }
  /// Values that count: stored ones that are not void, and readable unsaved ones unless the row is to become void.
  std::vector<double> values() const;
  /// Repeats from the first to the last that stands in the row.
  int repeats() const;
  /// The unsaved edit as records: typed values; a void row is filled up with void records to the wanted number.
  std::vector<MeasurementRecord> records(const QString& who) const;
};

}  // namespace btr::ui
