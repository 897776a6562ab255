#pragma once
#include <QUndoStack>
#include <QWidget>

#include "ui/gap/mapping_draft.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace btr::ui {

/// Which column of a recording is which channel: a line a channel with column, unit, scale, sign, offset, and the range
/// that comes out. What is not allowed is marked and said; every change can be undone. Saved beside the data as
/// NAME.mapping.json.
class MappingForm : public QWidget {
  Q_OBJECT
 public:
  enum Column { channel, column, unit, scale, flip, offset, range, columns };
  explicit MappingForm(QWidget* parent = nullptr);

  /// Opens a recording with its mapping: `mapping`, else the one beside it, else a guess from its column names. Throws
  /// InputError and keeps what was there.
  void open(const QString& recording, const QString& mapping = {});
  /// Names that the scene has, offered in the channel's field.
  void setChannels(const QStringList& channels);

  const MappingDraft& draft() const { return draft_; }
  MappingProblems problems() const { return problemsOf(draft_, preview_.columns); }
  bool isValid() const { return problems().empty(); }
  QString recording() const { return recording_; }
  /// NAME.mapping.json beside the recording, mapping.json where it is for all of the folder, or the file that was given
  /// where that fits the recording.
  QString file() const { return file_; }
  bool isChanged() const { return !undo_.isClean(); }
  /// Somebody changed it: a guess that nobody touched is not saved, and nothing is lost with it.
  bool isEdited() const { return isChanged() && undo_.canUndo(); }
  /// Whether it is saved as mapping.json, for all recordings of the folder.
  void setForAll(bool all);
  /// Throws InputError if something is not allowed, the file cannot be written, or one that was not read from is there.
  void save();

  QTableWidget& table() { return *table_; }
  QUndoStack& undoStack() { return undo_; }
  void addRow();
  void removeRow();

 signals:
  void saved(const QString& file);
  void failed(const QString& message);

 private:
  void change(const QString& text, MappingDraft next);
  void show();
  void readCell(int row, int column);
  QString fileOfOne() const;
  QString fileOfAll() const;

  MappingDraft draft_;
  CsvPreview preview_;
  QString recording_, file_;
  QString readFrom_;  ///< the file that the draft came from or was saved to; empty: none
  QStringList channels_;
  QUndoStack undo_;
  bool showing_ = false;
  QTableWidget* table_;
  QLabel *title_, *problem_;
  QPushButton *add_, *remove_, *save_;
  QCheckBox* forAll_;
};

}  // namespace btr::ui
