#pragma once
#include <QString>
#include <map>
#include <utility>
#include <vector>

#include "core/store/records.h"

namespace btr::ui {

/// One trial that a person has entered: a number as it was typed, or no number if the robot fell.
struct TypedValue {
  QString text;
  bool isVoid = false;  ///< counts in no mean
  bool operator==(const TypedValue&) const = default;
  bool isEmpty() const { return text.isEmpty() && !isVoid; }
};

/// What a person has entered for one individual and not saved yet.
struct MeasurementEdit {
  std::vector<TypedValue> values;  ///< repeats that follow the saved ones; empty where nothing stands
  bool isVoid = false;             ///< the whole row: it fell or cannot be measured
  QString note;
  bool operator==(const MeasurementEdit&) const = default;
  bool isEmpty() const;
};

/// The unsaved edits of one run by stage and individual. They outlive the window as text.
using MeasurementDraft = std::map<std::pair<int, Id>, MeasurementEdit>;
QString toText(const MeasurementDraft& draft);
/// What toText() wrote; empty if it is anything else.
MeasurementDraft draftFromText(const QString& text);

/// One individual of the sheet: its task, its stored values, its unsaved edit.
struct MeasurementRow {
  enum class State { open, begun, measured, isVoid };

  MeasurementTask task;
  std::vector<MeasurementRecord> saved;  ///< in the order in which they were entered
  MeasurementEdit edit;
  bool isAwaited = false;  ///< the edit was submitted and is not among `saved` yet
  int awaited = 0;         ///< as many further values

  /// An individual is done once as many values as wanted are stored, void ones too: measured, or void if all of them
  /// are.
  State state() const;
  bool isDone() const { return state() == State::measured || state() == State::isVoid; }
  /// True once the values that were entered make it done when they are saved.
  bool isEntered() const;
  /// Values that count: stored and readable unsaved ones that are not void; none if the row is to become void.
  std::vector<double> values() const;
  /// Repeats from the first to the last that stands in the row.
  int repeats() const;
  /// The unsaved edit as records: what was entered. A void row is filled up with trials without a number to the wanted
  /// number; these are stored as void values of 0, as in a table that is imported.
  std::vector<MeasurementRecord> records(const QString& who) const;
  /// Stored values that count and that the row takes along when it becomes void.
  std::vector<MeasurementRecord> toVoid() const;
};

}  // namespace btr::ui
