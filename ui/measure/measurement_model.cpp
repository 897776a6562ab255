#include "ui/measure/measurement_model.h"

#include <algorithm>
#include <map>

#include "core/run/reality/plausibility.h"

namespace btr::ui {

/// Rows before and after, so that a pasted block is one step.
class MeasurementModel::EditCommand final : public QUndoCommand {
 public:
  using Edits = std::vector<std::pair<int, MeasurementEdit>>;
  EditCommand(MeasurementModel& model, const QString& what, Edits before, Edits after)
      : QUndoCommand(what), model_(model), before_(std::move(before)), after_(std::move(after)) {}
  void undo() override { model_.apply(before_); }
  void redo() override { model_.apply(after_); }

 private:
  MeasurementModel& model_;
  Edits before_, after_;
};

MeasurementModel::MeasurementModel(QObject* parent) : QAbstractTableModel(parent) {}

void MeasurementModel::setUnit(const QString& unit) {
  unit_ = unit;
  emit headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
}

void MeasurementModel::setAllowed(const AllowedRange& allowed) {
  allowed_ = allowed;
  announceAll();
}

void MeasurementModel::setTasks(std::vector<MeasurementTask> tasks) {
  std::sort(tasks.begin(), tasks.end(), [](auto& a, auto& b) { return a.position < b.position; });
  const auto same = [](const MeasurementTask& a, const MeasurementRow& b) {
    return a.run == b.task.run && a.stage == b.task.stage && a.individual == b.task.individual;
  };
  if (std::equal(tasks.begin(), tasks.end(), rows_.begin(), rows_.end(), same)) {
    // The same sheet again, after a poll of the database: what was typed stays.
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].task = tasks[i];
    announceAll();
    return;
  }
  beginResetModel();
  MeasurementDraft kept = !tasks.empty() && tasks.front().run == run() ? draft() : MeasurementDraft();
  undo_.clear();
  rows_.clear();
  repeats_ = 1;
  for (MeasurementTask& task : tasks) {
    repeats_ = std::max(repeats_, task.wantedRepeats);
    MeasurementRow row;
    row.task = std::move(task);
    if (auto edit = kept.extract({row.task.stage, row.task.individual})) row.edit = std::move(edit.mapped());
    rows_.push_back(std::move(row));
  }
  elsewhere_ = std::move(kept);
  endResetModel();
  setMeasurements(measurements_);
}

void MeasurementModel::setMeasurements(const std::vector<MeasurementRecord>& measurements) {
  measurements_ = measurements;
  std::map<Id, std::vector<MeasurementRecord>> byIndividual;
  for (const MeasurementRecord& record : measurements) byIndividual[record.individual].push_back(record);
  bool arrived = false;
  int most = repeats_;
  for (MeasurementRow& row : rows_) {
    const auto before = row.saved.size();
    row.saved = byIndividual[row.task.individual];
    std::sort(row.saved.begin(), row.saved.end(), [](auto& a, auto& b) { return a.id < b.id; });
    if (row.isAwaited && row.saved.size() >= before + static_cast<std::size_t>(row.awaited) && row.toVoid().empty()) {
      row.edit = {};
      row.isAwaited = false;
      arrived = true;
    }
    most = std::max(most, row.repeats());
  }
  // Steps that would bring back what is stored by now make no sense any more.
  if (arrived) undo_.clear();
  growTo(most);
  announceAll();
  if (arrived) emit draftChanged();
}

void MeasurementModel::setSimulatedShown(bool shown) {
  simulatedShown_ = shown;
  announceAll();
}

bool MeasurementModel::isSimulatedVisible() const { return simulatedShown_ || isComplete(); }

void MeasurementModel::addRepeatColumn() { growTo(repeats_ + 1); }

void MeasurementModel::growTo(int repeats) {
  if (repeats <= repeats_) return;
  beginInsertColumns({}, meanColumn(), meanColumn() + repeats - repeats_ - 1);
  repeats_ = repeats;
  endInsertColumns();
}

void MeasurementModel::write(const std::vector<Text>& texts, const QString& what) {
  // Each row once, with all its new texts.
  std::map<int, MeasurementEdit> after;
  QStringList commas;
  int most = repeats_;
  for (const Text& text : texts) {
    if (text.row < 0 || text.row >= rowCount()) continue;
    const MeasurementRow& row = rows_[static_cast<std::size_t>(text.row)];
    MeasurementEdit& edit = after.try_emplace(text.row, row.edit).first->second;
    if (text.column == noteColumn()) {
      edit.note = text.text.trimmed();
      continue;
    }
    const int place = text.column - firstRepeat - static_cast<int>(row.saved.size());
    if (text.column < firstRepeat || place < 0) continue;
    const NumberEntry entry = readNumber(text.text);
    if (entry.converted) commas << tr("%1 read as %2").arg(text.text.trimmed(), entry.text);
    const bool isVoid = entry.text.compare(tr("void"), Qt::CaseInsensitive) == 0;
    if (place >= static_cast<int>(edit.values.size())) edit.values.resize(static_cast<std::size_t>(place) + 1);
    edit.values[static_cast<std::size_t>(place)] = {isVoid ? QString() : entry.text, isVoid};
    most = std::max(most, text.column - firstRepeat + 1);
  }
  EditCommand::Edits before, changes;
  for (auto& [row, edit] : after) {
    while (!edit.values.empty() && edit.values.back().isEmpty()) edit.values.pop_back();
    if (edit == rows_[static_cast<std::size_t>(row)].edit) continue;
    before.emplace_back(row, rows_[static_cast<std::size_t>(row)].edit);
    changes.emplace_back(row, std::move(edit));
  }
  if (changes.empty()) return;
  growTo(most);
  undo_.push(new EditCommand(*this, what, std::move(before), std::move(changes)));
  for (const Text& text : texts)
    if (const QString why = problem(text.row, text.column); !why.isEmpty()) {
      emit refused(text.row, why);
      break;
    }
  if (!commas.isEmpty()) emit converted(commas.mid(0, 3).join("; ") + (commas.size() > 3 ? "; …" : ""));
}

void MeasurementModel::setVoid(int row, bool isVoid) {
  MeasurementEdit after = rows_[static_cast<std::size_t>(row)].edit;
  after.isVoid = isVoid;
  change(row, std::move(after), tr("void"));
}

void MeasurementModel::setValueVoid(const QModelIndex& cell, bool isVoid) {
  const int place = unsavedPlace(cell.row(), cell.column());
  if (place < 0) return;
  MeasurementEdit after = rows_[static_cast<std::size_t>(cell.row())].edit;
  if (place >= static_cast<int>(after.values.size())) after.values.resize(static_cast<std::size_t>(place) + 1);
  after.values[static_cast<std::size_t>(place)].isVoid = isVoid;
  while (!after.values.empty() && after.values.back().isEmpty()) after.values.pop_back();
  change(cell.row(), std::move(after), tr("void"));
}

bool MeasurementModel::isValueVoid(const QModelIndex& cell) const {
  const int place = unsavedPlace(cell.row(), cell.column());
  if (place < 0) return false;
  const auto& values = rows_[static_cast<std::size_t>(cell.row())].edit.values;
  return place < static_cast<int>(values.size()) && values[static_cast<std::size_t>(place)].isVoid;
}

int MeasurementModel::unsavedPlace(int row, int column) const {
  if (row < 0 || row >= rowCount() || !isRepeat(column)) return -1;
  return std::max(-1, column - firstRepeat - static_cast<int>(rows_[static_cast<std::size_t>(row)].saved.size()));
}

void MeasurementModel::change(int row, MeasurementEdit after, const QString& what) {
  const MeasurementEdit& before = rows_[static_cast<std::size_t>(row)].edit;
  if (before == after) return;
  undo_.push(new EditCommand(*this, what, {{row, before}}, {{row, std::move(after)}}));
}

void MeasurementModel::apply(const std::vector<std::pair<int, MeasurementEdit>>& edits) {
  for (const auto& [row, edit] : edits) {
    rows_[static_cast<std::size_t>(row)].edit = edit;
    emit dataChanged(index(row, 0), index(row, columnCount() - 1));
  }
  emit changed();
  emit draftChanged();
}

void MeasurementModel::announceAll() {
  if (!rows_.empty()) emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
  emit changed();
}

bool MeasurementModel::hasUnsaved() const {
  return std::any_of(rows_.begin(), rows_.end(), [](auto& row) { return !row.edit.isEmpty(); });
}

MeasurementDraft MeasurementModel::draft() const {
  MeasurementDraft all = elsewhere_;
  for (const MeasurementRow& row : rows_)
    if (!row.edit.isEmpty()) all[{row.task.stage, row.task.individual}] = row.edit;
  return all;
}

void MeasurementModel::setDraft(MeasurementDraft draft) {
  int most = repeats_;
  for (MeasurementRow& row : rows_) {
    auto edit = draft.extract({row.task.stage, row.task.individual});
    if (edit && row.edit.isEmpty()) row.edit = std::move(edit.mapped());
    most = std::max(most, row.repeats());
  }
  elsewhere_.merge(draft);
  growTo(most);
  announceAll();
}

QString MeasurementModel::problem(int row, int column) const {
  const int place = unsavedPlace(row, column);
  if (place < 0) return {};
  const auto& values = rows_[static_cast<std::size_t>(row)].edit.values;
  if (place >= static_cast<int>(values.size())) return {};
  const QString& text = values[static_cast<std::size_t>(place)].text;
  if (text.isEmpty()) return {};
  const auto value = readNumber(text).value;
  if (value && allowed_.contains(*value)) return {};
  return tr("“%1” is not allowed here; allowed is %2. Type “void” if it fell.").arg(text, allowed_.text(unit_));
}

QModelIndex MeasurementModel::firstInvalid() const {
  for (int row = 0; row < rowCount(); ++row)
    for (int column = firstRepeat; column < meanColumn(); ++column)
      if (!problem(row, column).isEmpty()) return index(row, column);
  return {};
}

std::vector<MeasurementModel::DoubtfulCell> MeasurementModel::doubtful() const {
  KnownFitness known;
  for (const MeasurementRow& row : rows_) known.tasks.push_back(row.task);
  known.measurements = measurements_;
  known.unit = unit_.toStdString();
  std::vector<MeasurementRecord> entered;
  std::vector<QModelIndex> cells;
  for (int row = 0; row < rowCount(); ++row) {
    const MeasurementRow& r = rows_[static_cast<std::size_t>(row)];
    for (std::size_t k = 0; k < r.edit.values.size() && !r.edit.isVoid; ++k)
      if (const auto value = readNumber(r.edit.values[k].text).value; value && !r.edit.values[k].isVoid) {
        entered.emplace_back().value = *value;
        cells.push_back(index(row, firstRepeat + static_cast<int>(r.saved.size() + k)));
      }
  }
  std::vector<DoubtfulCell> all;
  for (const Doubt& doubt : doubts(known, entered))
    all.push_back({cells[doubt.index], QString::fromStdString(doubt.sentence)});
  return all;
}

std::vector<MeasurementRecord> MeasurementModel::toVoid() const {
  std::vector<MeasurementRecord> all;
  for (const MeasurementRow& row : rows_) {
    const std::vector<MeasurementRecord> some = row.toVoid();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<MeasurementRecord> MeasurementModel::submit(const QString& who) {
  std::vector<MeasurementRecord> all;
  for (MeasurementRow& row : rows_) {
    const std::vector<MeasurementRecord> records = row.records(who);
    row.awaited = static_cast<int>(records.size());
    row.isAwaited = !records.empty() || !row.toVoid().empty();
    all.insert(all.end(), records.begin(), records.end());
  }
  return all;
}

void MeasurementModel::submissionFailed() {
  for (MeasurementRow& row : rows_) row.isAwaited = false;
}

int MeasurementModel::doneCount() const {
  return static_cast<int>(std::count_if(rows_.begin(), rows_.end(), [](auto& row) { return row.isDone(); }));
}

int MeasurementModel::enteredCount() const {
  return static_cast<int>(std::count_if(rows_.begin(), rows_.end(), [](auto& row) { return row.isEntered(); }));
}

int MeasurementModel::voidCount() const {
  return static_cast<int>(std::count_if(rows_.begin(), rows_.end(),
                                        [](auto& row) { return row.state() == MeasurementRow::State::isVoid; }));
}

const MeasurementRecord* MeasurementModel::savedAt(const QModelIndex& index) const {
  if (!index.isValid() || !isRepeat(index.column())) return nullptr;
  const auto& saved = rows_[static_cast<std::size_t>(index.row())].saved;
  const auto place = static_cast<std::size_t>(index.column() - firstRepeat);
  return place < saved.size() ? &saved[place] : nullptr;
}

}  // namespace btr::ui
