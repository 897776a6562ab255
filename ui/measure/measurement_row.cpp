#include "ui/measure/measurement_row.h"

#include <algorithm>

#include "core/run/reality/reality_gap.h"
#include "ui/common/numbers/number_entry.h"

namespace btr::ui {

bool MeasurementEdit::isEmpty() const {
  return !isVoid && note.isEmpty() &&
         std::all_of(values.begin(), values.end(), [](auto& value) { return value.isEmpty(); });
}

MeasurementRow::State MeasurementRow::state() const {
  const auto valid = std::count_if(saved.begin(), saved.end(), [](auto& record) { return !record.isVoid; });
  if (!saved.empty() && isSettled(task, saved)) return valid > 0 ? State::measured : State::isVoid;
  return saved.empty() && edit.isEmpty() ? State::open : State::begun;
}

bool MeasurementRow::isEntered() const {
  return !isDone() && (edit.isVoid || static_cast<int>(saved.size() + records({}).size()) >= task.wantedRepeats);
}

std::vector<double> MeasurementRow::values() const {
  std::vector<double> all;
  if (edit.isVoid) return all;
  for (const MeasurementRecord& record : saved)
    if (!record.isVoid) all.push_back(record.value);
  for (const TypedValue& typed : edit.values)
    if (const auto value = readNumber(typed.text).value; value && !typed.isVoid) all.push_back(*value);
  return all;
}

int MeasurementRow::repeats() const {
  const auto last =
      std::find_if(edit.values.rbegin(), edit.values.rend(), [](auto& value) { return !value.isEmpty(); });
  return static_cast<int>(saved.size()) + static_cast<int>(edit.values.rend() - last);
}

std::vector<MeasurementRecord> MeasurementRow::records(const QString& who) const {
  std::vector<MeasurementRecord> records;
  const auto add = [&](double value, bool isVoid) {
    MeasurementRecord record;
    record.run = task.run;
    record.individual = task.individual;
    record.value = value;
    record.isVoid = isVoid;
    record.note = edit.note.toStdString();
    record.who = who.toStdString();
    record.source = "person";
    records.push_back(std::move(record));
  };
  for (const TypedValue& typed : edit.values) {
    if (const auto value = readNumber(typed.text).value)
      add(*value, typed.isVoid || edit.isVoid);
    else if (typed.isVoid && typed.text.isEmpty())
      add(0, true);
  }
  if (edit.isVoid)
    while (static_cast<int>(saved.size() + records.size()) < std::max(1, task.wantedRepeats)) add(0, true);
  return records;
}

std::vector<MeasurementRecord> MeasurementRow::toVoid() const {
  std::vector<MeasurementRecord> all;
  for (const MeasurementRecord& record : saved)
    if (edit.isVoid && !record.isVoid) all.push_back(record);
  return all;
}

}  // namespace btr::ui
