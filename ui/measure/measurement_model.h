#pragma once
#include <QAbstractTableModel>
#include <QUndoStack>

#include "ui/common/numbers/number_entry.h"
#include "ui/measure/measurement_row.h"

namespace btr::ui {

/// The measurement sheet's numbers: one row an individual in the drawn order, several repeats as columns. Stored values
/// are read-only; typed ones wait, undoable, until they are submitted and come back among the stored ones. While blind,
/// the simulated fitness is in no answer of this model, whatever the role.
class MeasurementModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  explicit MeasurementModel(QObject* parent = nullptr);

  // ---- what the sheet is about
  void setUnit(const QString& unit);
  void setAllowed(const AllowedRange& allowed);
  /// Individuals of one stage or iteration. Unsaved edits of another one of the same run are kept and come back with
  /// it; those of another run are dropped: draft() has them until then.
  void setTasks(std::vector<MeasurementTask> tasks);
  /// The run of these individuals, 0 if there are none.
  Id run() const { return rows_.empty() ? 0 : rows_.front().task.run; }
  /// Everything stored for the run; what was submitted and is now here loses its unsaved text.
  void setMeasurements(const std::vector<MeasurementRecord>& measurements);
  const std::vector<MeasurementRow>& rows() const { return rows_; }

  // ---- blindness
  void setSimulatedShown(bool shown);
  bool isSimulatedShown() const { return simulatedShown_; }
  /// The switch is on, or every individual is done.
  bool isSimulatedVisible() const;

  // ---- columns
  static constexpr int positionColumn = 0, individualColumn = 1, simulatedColumn = 2, firstRepeat = 3;
  int repeatColumns() const { return repeats_; }
  void addRepeatColumn();
  int meanColumn() const { return firstRepeat + repeats_; }
  int countColumn() const { return meanColumn() + 1; }
  int voidColumn() const { return meanColumn() + 2; }
  /// Why it was chosen; a rank or a spread would tell the simulated fitness, so these follow its blindness.
  int reasonColumn() const { return meanColumn() + 3; }
  int noteColumn() const { return meanColumn() + 4; }
  /// Without data: the view puts its buttons there.
  int replayColumn() const { return meanColumn() + 5; }
  bool isRepeat(int column) const { return column >= firstRepeat && column < meanColumn(); }

  // ---- unsaved edits; each call is one step of the undo stack
  struct Text {
    int row = 0, column = 0;
    QString text;
  };
  /// Writes texts into unsaved repeats and notes; others are left alone. Adds repeat columns where needed.
  /// "void" stands for a trial without a number.
  void write(const std::vector<Text>& texts, const QString& what);
  /// The whole row: what stands in it, saved or not, and what is missing.
  void setVoid(int row, bool isVoid);
  /// One repeat that is not saved yet.
  void setValueVoid(const QModelIndex& cell, bool isVoid);
  bool isValueVoid(const QModelIndex& cell) const;
  bool isUnsavedRepeat(const QModelIndex& cell) const { return unsavedPlace(cell.row(), cell.column()) >= 0; }
  QUndoStack& undoStack() { return undo_; }
  bool hasUnsaved() const;
  /// All unsaved edits of the run, of its other stages too.
  MeasurementDraft draft() const;
  /// Puts back what draft() gave; edits that stand here already stay.
  void setDraft(MeasurementDraft draft);
  /// First cell whose text is not allowed, in reading order; an invalid index if all are.
  QModelIndex firstInvalid() const;
  /// Why the cell is not allowed, "" if it is.
  QString problem(int row, int column) const;
  /// Unsaved values that are allowed and yet far from what is expected of them, in reading order.
  struct DoubtfulCell {
    QModelIndex cell;
    QString sentence;
  };
  std::vector<DoubtfulCell> doubtful() const;
  /// Stored values that count and that rows to become void would take along.
  std::vector<MeasurementRecord> toVoid() const;
  /// Unsaved values as records, to be handed to the store. They stay unsaved until setMeasurements brings them, and
  /// toVoid() as void ones.
  std::vector<MeasurementRecord> submit(const QString& who);
  /// The store refused: nothing is awaited any more.
  void submissionFailed();

  // ---- progress
  int doneCount() const;
  int enteredCount() const;  ///< not done yet, but done when they are saved
  int voidCount() const;
  bool isComplete() const { return !rows_.empty() && doneCount() == static_cast<int>(rows_.size()); }
  /// The stored record shown in a cell, or nullptr.
  const MeasurementRecord* savedAt(const QModelIndex& index) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;

 signals:
  /// Rows done, unsaved edits or blindness changed.
  void changed();
  /// What is not saved became other than it was: by the user, or since it is stored by now.
  void draftChanged();
  /// A decimal comma was read as a point.
  void converted(const QString& message);
  /// What was just entered is not allowed; it stands there, marked, and cannot be saved.
  void refused(int row, const QString& why);

 private:
  class EditCommand;
  QVariant textAt(const MeasurementRow& row, int column) const;
  QVariant shownAt(const QModelIndex& index) const;
  QVariant toolTipAt(const QModelIndex& index) const;
  QVariant colourAt(const QModelIndex& index, int role) const;
  /// Its place among the unsaved values of the row, −1 if it is none.
  int unsavedPlace(int row, int column) const;
  void change(int row, MeasurementEdit after, const QString& what);
  void apply(const std::vector<std::pair<int, MeasurementEdit>>& edits);
  void growTo(int repeats);
  void announceAll();

  QString unit_;
  AllowedRange allowed_;
  std::vector<MeasurementRow> rows_;
  std::vector<MeasurementRecord> measurements_;
  MeasurementDraft elsewhere_;  ///< edits of the run that are not in these rows
  int repeats_ = 1;
  bool simulatedShown_ = false;
  QUndoStack undo_;
};

}  // namespace btr::ui
