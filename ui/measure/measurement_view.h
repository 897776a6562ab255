#pragma once
#include <QTableView>

#include "ui/measure/measurement_model.h"

namespace btr::ui {

/// The sheet's table, worked like a spreadsheet: type to enter, Enter goes down, Tab to the next cell to fill, Enter
/// after it to the next row where Tab began, arrows move (while typing: up and down), Delete clears what is not saved,
/// Ctrl+C and Ctrl+V exchange blocks with a spreadsheet.
class MeasurementView : public QTableView {
  Q_OBJECT

 public:
  MeasurementView(MeasurementModel& model, QWidget* parent);

  void copySelection() const;
  /// A block of tabs and newlines (or ; or a column of numbers) from the current cell on, one step of the undo stack.
  void paste();
  void clearUnsaved();
  /// The first cell in which a value is missing becomes the current one.
  void goToNextOpen();
  /// Of the rows with a selected cell, from above.
  std::vector<Id> selectedIndividuals() const;

 signals:
  /// Pasted texts for which there was no free cell.
  void leftOut(const QStringList& texts);
  /// Pasted texts like "1.234" between decimal commas: not pasted, as they may be thousands.
  void unclear(const QStringList& texts);
  void replayRequested(btr::Id individual);
  void voidRequested(const QModelIndex& savedCell);
  void parametersRequested(const std::vector<btr::Id>& individuals, bool asFile);

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;
  QModelIndex moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  void placeButtons();
  void arrangeColumns();
  void fitNote();
  void moveDown();
  void moveAlong(int direction);
  QModelIndex nextEditable(const QModelIndex& from, int direction) const;

  MeasurementModel& model_;
  int tabFrom_ = -1;  ///< the column in which the first of the last Tabs was pressed; −1: another key came since
};

/// Rows and cells of text from a clipboard or a CSV file: lines, then tabs; without tabs semicolons; without these
/// commas, unless every comma of the block can be a decimal one (at most one a line; "1.234,5" stays whole).
std::vector<QStringList> cellsOf(const QString& text);

}  // namespace btr::ui
