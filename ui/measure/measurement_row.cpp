#include "ui/measure/measurement_row.h"

#include <algorithm>

#include "core/run/reality_gap.h"
#include "ui/measure/number_entry.h"

namespace btr::ui {

bool MeasurementEdit::isEmpty() const {
  return !isVoid && note.isEmpty() &&
         std::all_of(texts.begin(), texts.end(), [](auto& text) { return text.isEmpty(); });
}

MeasurementRow::State MeasurementRow::state() const {
  const auto valid = std::count_if(saved.begin(), saved.end(), [](auto& record) { return !record.isVoid; });
  if (!saved.empty() && isSettled(task, saved)) return valid > 0 ? State::measured : State::isVoid;
  return saved.empty() && edit.isEmpty() ? State::open : State::begun;
}

std::vector<double> MeasurementRow::values() const {
  std::vector<double> all;
  for (const MeasurementRecord& record : saved)
    if (!record.isVoid) all.push_back(record.value);
  if (edit.isVoid) return all;
  for (const QString& text : edit.texts)
    if (const auto value = readNumber(text).value) all.push_back(*value);
  return all;
}

int MeasurementRow::repeats() const {
  const auto last = std::find_if(edit.texts.rbegin(), edit.texts.rend(), [](auto& text) { return !text.isEmpty(); });
  return static_cast<int>(saved.size()) + static_cast<int>(edit.texts.rend() - last);
}

std::vector<MeasurementRecord> MeasurementRow::records(const QString& who) const {
  std::vector<MeasurementRecord> records;
  const auto add = [&](double value) {
    MeasurementRecord record;
    record.run = task.run;
    record.individual = task.individual;
    record.value = value;
    record.isVoid = edit.isVoid;
    record.note = edit.note.toStdString();
    record.who = who.toStdString();
    record.source = "person";
    records.push_back(std::move(record));
  };
  for (const QString& text : edit.texts)
    if (const auto value = readNumber(text).value) add(*value);
  if (edit.isVoid)
    while (records.empty() || static_cast<int>(saved.size() + records.size()) < task.wantedRepeats) add(0);
  return records;
}

}  // namespace btr::ui
