#include "ui/measure/measurement_view.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QRegularExpression>
#include <QToolButton>
#include <algorithm>
#include <set>

#include "ui/common/look/theme.h"
#include "ui/common/numbers/number_entry.h"
#include "ui/measure/measurement_delegate.h"

namespace btr::ui {
namespace {

/// "1.234" or "1,234": with this mark between thousands it would be another number.
bool mayBeThousands(const QString& text, QChar mark) {
  static const QRegularExpression points(QStringLiteral(R"(^[-+\x{2212}]?[1-9]\d{0,2}(\.\d{3})+$)")),
      commas(QStringLiteral(R"(^[-+\x{2212}]?[1-9]\d{0,2}(,\d{3})+$)"));
  return (mark == '.' ? points : commas).match(text.trimmed()).hasMatch();
}

/// "1.234,5": one number with a decimal comma, or two that a comma divides.
bool mayBeGermanThousands(const QString& line) {
  static const QRegularExpression grouped(QStringLiteral(R"(^\s*[-+\x{2212}]?[1-9]\d{0,2}(\.\d{3})+,\d+\s*$)"));
  return grouped.match(line).hasMatch();
}

/// The decimal mark of a block, as those of its numbers show that can be read in one way only; both may be there.
struct DecimalMarks {
  bool point = false, comma = false;
  explicit DecimalMarks(const std::vector<QStringList>& cells) {
    for (const QStringList& line : cells)
      for (const QString& cell : line) {
        if (!readNumber(cell).value) continue;
        point |= cell.contains('.') && !mayBeThousands(cell, '.');
        comma |= cell.contains(',') && !mayBeThousands(cell, ',');
      }
  }
  /// Whether the other mark of the block says that this one divides thousands.
  bool contradict(const QString& cell) const {
    return (comma && mayBeThousands(cell, '.')) || (point && mayBeThousands(cell, ','));
  }
};

}  // namespace

MeasurementView::MeasurementView(MeasurementModel& model, QWidget* parent) : QTableView(parent), model_(model) {
  setModel(&model);
  setItemDelegate(new MeasurementDelegate(model, this));
  setSelectionMode(QAbstractItemView::ContiguousSelection);
  setEditTriggers(AnyKeyPressed | DoubleClicked | EditKeyPressed);
  setAlternatingRowColors(true);
  setAccessibleName(tr("Measurements"));
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 12);
  horizontalHeader()->setHighlightSections(false);
  setHorizontalScrollMode(ScrollPerPixel);
  connect(&model, &QAbstractItemModel::modelReset, this, &MeasurementView::placeButtons);
  connect(&model, &QAbstractItemModel::columnsInserted, this, &MeasurementView::arrangeColumns);
  connect(&model, &MeasurementModel::changed, this, [this] {
    const bool hidden = !model_.isSimulatedVisible();
    if (isColumnHidden(MeasurementModel::simulatedColumn) == hidden) return;
    setColumnHidden(MeasurementModel::simulatedColumn, hidden);
    arrangeColumns();
  });
  placeButtons();
}

void MeasurementView::placeButtons() {
  for (int row = 0; row < model_.rowCount(); ++row) {
    auto* button = new QToolButton(this);
    button->setText(tr("Replay"));
    button->setIcon(themeIcon("media-playback-start"));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    const Id individual = model_.rows()[static_cast<std::size_t>(row)].task.individual;
    button->setAccessibleName(tr("Replay individual %1").arg(individual));
    button->setToolTip(tr("Show individual %1 in the 3D view (Ctrl+R)").arg(individual));
    connect(button, &QToolButton::clicked, this, [this, individual] { emit replayRequested(individual); });
    setIndexWidget(model_.index(row, model_.replayColumn()), button);
  }
  setColumnHidden(MeasurementModel::simulatedColumn, !model_.isSimulatedVisible());
  arrangeColumns();
  goToNextOpen();
}

void MeasurementView::arrangeColumns() {
  const int digit = fontMetrics().horizontalAdvance('0');
  for (int column = 0; column < model_.columnCount(); ++column) {
    const QString header = model_.headerData(column, Qt::Horizontal).toString();
    int width = fontMetrics().horizontalAdvance(header) + 3 * digit;
    if (model_.isRepeat(column)) width = std::max(width, 12 * digit);
    if (column == model_.meanColumn()) width = std::max(width, 18 * digit);
    if (column == model_.replayColumn()) width = std::max(width, 12 * digit);
    // The reason is a phrase, not a number: none of it may be cut off.
    for (int row = 0; column == model_.reasonColumn() && row < model_.rowCount(); ++row)
      width = std::max(width, fontMetrics().horizontalAdvance(model_.index(row, column).data().toString()) + 3 * digit);
    setColumnWidth(column, width);
  }
  fitNote();
  // The buttons follow their column.
  scheduleDelayedItemsLayout();
}

/// The note takes what the other columns leave, and enough to be read where they leave nothing.
void MeasurementView::fitNote() {
  const int note = model_.noteColumn(), least = fontMetrics().horizontalAdvance('0') * 16;
  const int others = horizontalHeader()->length() - columnWidth(note);
  setColumnWidth(note, std::max(least, viewport()->width() - others));
}

void MeasurementView::resizeEvent(QResizeEvent* event) {
  QTableView::resizeEvent(event);
  fitNote();
}

QModelIndex MeasurementView::nextEditable(const QModelIndex& from, int direction) const {
  const int columns = model_.columnCount(), cells = model_.rowCount() * columns;
  for (int cell = from.row() * columns + from.column() + direction; cell >= 0 && cell < cells; cell += direction) {
    const QModelIndex index = model_.index(cell / columns, cell % columns);
    if (model_.flags(index) & (Qt::ItemIsEditable | Qt::ItemIsUserCheckable)) return index;
  }
  return from;
}

QModelIndex MeasurementView::moveCursor(CursorAction action, Qt::KeyboardModifiers modifiers) {
  if (action != MoveNext && action != MovePrevious) {
    tabFrom_ = -1;
    return QTableView::moveCursor(action, modifiers);
  }
  if (tabFrom_ < 0) tabFrom_ = currentIndex().column();
  return nextEditable(currentIndex(), action == MoveNext ? 1 : -1);
}

void MeasurementView::moveDown() {
  const QModelIndex here = currentIndex();
  const int column = tabFrom_ < 0 ? here.column() : tabFrom_;
  tabFrom_ = -1;
  if (here.isValid() && here.row() + 1 < model_.rowCount()) setCurrentIndex(model_.index(here.row() + 1, column));
}

void MeasurementView::moveAlong(int direction) {
  if (tabFrom_ < 0) tabFrom_ = currentIndex().column();
  setCurrentIndex(nextEditable(currentIndex(), direction));
}

void MeasurementView::mousePressEvent(QMouseEvent* event) {
  tabFrom_ = -1;
  QTableView::mousePressEvent(event);
}

void MeasurementView::closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) {
  // Move on without opening the next editor: the next key starts it.
  QTableView::closeEditor(editor, QAbstractItemDelegate::NoHint);
  if (hint == QAbstractItemDelegate::SubmitModelCache) moveDown();
  if (hint == QAbstractItemDelegate::EditNextItem) moveAlong(1);
  if (hint == QAbstractItemDelegate::EditPreviousItem) moveAlong(-1);
}

void MeasurementView::keyPressEvent(QKeyEvent* event) {
  if (state() == EditingState) return QTableView::keyPressEvent(event);
  if (event->matches(QKeySequence::Copy)) return copySelection();
  if (event->matches(QKeySequence::Cut)) {
    copySelection();
    return clearUnsaved();
  }
  if (event->matches(QKeySequence::Paste)) return paste();
  switch (event->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return moveDown();
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      return clearUnsaved();
    case Qt::Key_R:
      if (event->modifiers() == Qt::ControlModifier && currentIndex().isValid()) {
        emit replayRequested(model_.rows()[static_cast<std::size_t>(currentIndex().row())].task.individual);
        return;
      }
      break;
    default:
      break;
  }
  QTableView::keyPressEvent(event);
}

void MeasurementView::copySelection() const {
  QModelIndexList cells = selectedIndexes();
  std::sort(cells.begin(), cells.end());
  QString text;
  for (qsizetype i = 0; i < cells.size(); ++i) {
    if (isColumnHidden(cells[i].column())) continue;
    if (i > 0 && !text.isEmpty()) text += cells[i].row() == cells[i - 1].row() ? '\t' : '\n';
    text += cells[i].data(Qt::EditRole).toString();
  }
  QApplication::clipboard()->setText(text);
}

void MeasurementView::paste() {
  const QModelIndex corner = currentIndex();
  if (!corner.isValid()) return;
  const bool isNote = corner.column() == model_.noteColumn();
  if (!isNote && !model_.isRepeat(corner.column())) return;
  std::vector<MeasurementModel::Text> texts;
  QStringList leftOut, unclear;
  int row = corner.row();
  const std::vector<QStringList> cells = cellsOf(QApplication::clipboard()->text());
  const DecimalMarks marks(cells);
  for (const QStringList& line : cells) {
    // A block may be wider than the sheet: it adds repeats. Only the note column takes anything but repeats.
    for (int i = 0; i < line.size(); ++i) {
      const int column = corner.column() + i;
      const bool isStored = model_.savedAt(model_.index(row, column)) != nullptr;
      if (!isNote && marks.contradict(line[i]))
        unclear << line[i].trimmed();
      else if (row < model_.rowCount() && !isStored && (!isNote || i == 0))
        texts.push_back({row, column, line[i]});
      else if (!line[i].trimmed().isEmpty())
        leftOut << line[i].trimmed();
    }
    ++row;
  }
  model_.write(texts, tr("paste"));
  if (!leftOut.isEmpty()) emit this->leftOut(leftOut);
  if (!unclear.isEmpty()) emit this->unclear(unclear);
}

void MeasurementView::clearUnsaved() {
  std::vector<MeasurementModel::Text> texts;
  for (const QModelIndex& index : selectedIndexes())
    if (model_.isRepeat(index.column()) || index.column() == model_.noteColumn())
      texts.push_back({index.row(), index.column(), {}});
  model_.write(texts, tr("delete"));
}

void MeasurementView::goToNextOpen() {
  for (int row = 0; row < model_.rowCount(); ++row) {
    const MeasurementRow& r = model_.rows()[static_cast<std::size_t>(row)];
    if (r.isDone() || r.edit.isVoid) continue;
    if (r.repeats() >= std::max(1, r.task.wantedRepeats)) continue;
    setCurrentIndex(model_.index(row, MeasurementModel::firstRepeat + r.repeats()));
    return;
  }
}

std::vector<Id> MeasurementView::selectedIndividuals() const {
  std::set<int> rows;
  for (const QModelIndex& index : selectedIndexes()) rows.insert(index.row());
  std::vector<Id> all;
  for (const int row : rows) all.push_back(model_.rows()[static_cast<std::size_t>(row)].task.individual);
  return all;
}

void MeasurementView::contextMenuEvent(QContextMenuEvent* event) {
  const QModelIndex index = indexAt(event->pos());
  if (!index.isValid()) return;
  QMenu menu(this);
  const Id individual = model_.rows()[static_cast<std::size_t>(index.row())].task.individual;
  menu.addAction(themeIcon("media-playback-start"), tr("Replay individual %1").arg(individual), this,
                 [this, individual] { emit replayRequested(individual); });
  menu.addSeparator();
  menu.addAction(themeIcon("edit-copy"), tr("Copy"), this, &MeasurementView::copySelection);
  menu.addAction(themeIcon("edit-paste"), tr("Paste"), this, &MeasurementView::paste);
  menu.addAction(themeIcon("edit-delete"), tr("Clear what is not saved"), this, &MeasurementView::clearUnsaved);
  if (const MeasurementRecord* saved = model_.savedAt(index)) {
    menu.addSeparator();
    menu.addAction(saved->isVoid ? tr("Count this value again…") : tr("Void this value…"), this,
                   [this, index] { emit voidRequested(index); });
  } else if (model_.isUnsavedRepeat(index)) {
    menu.addSeparator();
    const bool isVoid = model_.isValueVoid(index), hasNumber = !index.data(Qt::EditRole).toString().isEmpty();
    menu.addAction(isVoid      ? tr("Count this trial again")
                   : hasNumber ? tr("Void this value")
                               : tr("Void this trial: it fell, there is no number"),
                   this, [this, index, isVoid] { model_.setValueVoid(index, !isVoid); });
  }
  menu.addSeparator();
  menu.addAction(themeIcon("edit-copy"), tr("Copy parameters of the selected rows"), this,
                 [this] { emit parametersRequested(selectedIndividuals(), false); });
  menu.addAction(themeIcon("document-save-as"), tr("Save parameters of the selected rows as CSV…"), this,
                 [this] { emit parametersRequested(selectedIndividuals(), true); });
  menu.exec(event->globalPos());
}

std::vector<QStringList> cellsOf(const QString& text) {
  QString clean = text;
  clean.replace("\r\n", "\n").replace('\r', '\n');
  while (clean.endsWith('\n')) clean.chop(1);
  const QStringList lines = clean.split('\n');
  QChar between = '\t';
  if (!clean.contains('\t')) {
    const bool manyCommas = std::any_of(lines.begin(), lines.end(), [](const QString& line) {
      return line.count(',') > 1 || (line.contains(',') && line.contains('.') && !mayBeGermanThousands(line));
    });
    between = clean.contains(';') ? ';' : manyCommas ? ',' : '\t';
  }
  std::vector<QStringList> cells;
  for (const QString& line : lines) cells.push_back(line.split(between));
  return cells;
}

}  // namespace btr::ui
