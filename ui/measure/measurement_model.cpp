#include "ui/measure/measurement_model.h"

#include <algorithm>
#include <map>

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
  undo_.clear();
  rows_.clear();
  repeats_ = 1;
  for (MeasurementTask& task : tasks) {
    repeats_ = std::max(repeats_, task.wantedRepeats);
    MeasurementRow row;
    row.task = std::move(task);
    rows_.push_back(std::move(row));
  }
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
    if (row.awaited > 0 && row.saved.size() >= before + static_cast<std::size_t>(row.awaited)) {
      row.edit = {};
      row.awaited = 0;
      arrived = true;
    }
    most = std::max(most, row.repeats());
  }
  // Steps that would bring back what is stored by now make no sense any more.
  if (arrived) undo_.clear();
  growTo(most);
  announceAll();
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
    if (place >= static_cast<int>(edit.texts.size())) edit.texts.resize(static_cast<std::size_t>(place) + 1);
    edit.texts[static_cast<std::size_t>(place)] = entry.text;
    most = std::max(most, text.column - firstRepeat + 1);
  }
  EditCommand::Edits before, changes;
  for (auto& [row, edit] : after) {
    while (!edit.texts.empty() && edit.texts.back().isEmpty()) edit.texts.pop_back();
    if (edit == rows_[static_cast<std::size_t>(row)].edit) continue;
    before.emplace_back(row, rows_[static_cast<std::size_t>(row)].edit);
    changes.emplace_back(row, std::move(edit));
  }
  if (changes.empty()) return;
  growTo(most);
  undo_.push(new EditCommand(*this, what, std::move(before), std::move(changes)));
  if (!commas.isEmpty()) emit converted(commas.mid(0, 3).join("; ") + (commas.size() > 3 ? "; …" : ""));
}

void MeasurementModel::setVoid(int row, bool isVoid) {
  const MeasurementEdit before = rows_[static_cast<std::size_t>(row)].edit;
  if (before.isVoid == isVoid) return;
  MeasurementEdit after = before;
  after.isVoid = isVoid;
  undo_.push(new EditCommand(*this, tr("void"), {{row, before}}, {{row, after}}));
}

void MeasurementModel::apply(const std::vector<std::pair<int, MeasurementEdit>>& edits) {
  for (const auto& [row, edit] : edits) {
    rows_[static_cast<std::size_t>(row)].edit = edit;
    emit dataChanged(index(row, 0), index(row, columnCount() - 1));
  }
  emit changed();
}

void MeasurementModel::announceAll() {
  if (!rows_.empty()) emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
  emit changed();
}

bool MeasurementModel::hasUnsaved() const {
  return std::any_of(rows_.begin(), rows_.end(), [](auto& row) { return !row.edit.isEmpty(); });
}

QString MeasurementModel::problem(int row, int column) const {
  if (!isRepeat(column)) return {};
  const MeasurementRow& r = rows_[static_cast<std::size_t>(row)];
  const int place = column - firstRepeat - static_cast<int>(r.saved.size());
  if (place < 0 || place >= static_cast<int>(r.edit.texts.size())) return {};
  const QString& text = r.edit.texts[static_cast<std::size_t>(place)];
  if (text.isEmpty()) return {};
  const auto value = readNumber(text).value;
  if (value && allowed_.contains(*value)) return {};
  return tr("“%1” is not allowed here; allowed is %2. Tick “void” if it fell.").arg(text, allowed_.text(unit_));
}

QModelIndex MeasurementModel::firstInvalid() const {
  for (int row = 0; row < rowCount(); ++row)
    for (int column = firstRepeat; column < meanColumn(); ++column)
      if (!problem(row, column).isEmpty()) return index(row, column);
  return {};
}

std::vector<MeasurementRecord> MeasurementModel::submit(const QString& who) {
  std::vector<MeasurementRecord> all;
  for (MeasurementRow& row : rows_) {
    const std::vector<MeasurementRecord> records = row.records(who);
    row.awaited = static_cast<int>(records.size());
    all.insert(all.end(), records.begin(), records.end());
  }
  return all;
}

void MeasurementModel::submissionFailed() {
  for (MeasurementRow& row : rows_) row.awaited = 0;
}

int MeasurementModel::doneCount() const {
  return static_cast<int>(std::count_if(rows_.begin(), rows_.end(), [](auto& row) { return row.isDone(); }));
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
