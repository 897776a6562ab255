#include "ui/measure/measurement_delegate.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>

#include "ui/common/look/theme.h"

namespace btr::ui {

MeasurementDelegate::MeasurementDelegate(const MeasurementModel& model, QObject* parent)
    : QStyledItemDelegate(parent), model_(model) {}

void MeasurementDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  if (index.column() == model_.voidColumn()) return paintBox(*painter, option, index);
  QStyledItemDelegate::paint(painter, option, index);
  if (model_.problem(index.row(), index.column()).isEmpty()) return;
  painter->save();
  painter->setPen(QPen(tonesOf(QGuiApplication::palette()).bad, 2));
  painter->drawRect(option.rect.adjusted(1, 1, -1, -1));
  painter->restore();
}

void MeasurementDelegate::paintBox(QPainter& painter, const QStyleOptionViewItem& option,
                                   const QModelIndex& index) const {
  // The cell's own background and selection, then a box that is seen in light and dark.
  QStyleOptionViewItem cell = option;
  initStyleOption(&cell, index);
  cell.features &= ~QStyleOptionViewItem::HasCheckIndicator;
  cell.text.clear();
  QApplication::style()->drawControl(QStyle::CE_ItemViewItem, &cell, &painter, cell.widget);

  const Tones tones = tonesOf(QGuiApplication::palette());
  const bool checked = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
  const bool changeable = index.flags() & Qt::ItemIsUserCheckable;
  QRectF box(0, 0, 13, 13);
  box.moveCenter(QRectF(option.rect).center());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor frame = option.state & QStyle::State_Selected ? option.palette.highlightedText().color() : tones.muted;
  painter.setPen(QPen(frame, 1.2));
  painter.setBrush(checked ? QBrush(changeable ? tones.warning : tones.muted) : QBrush(Qt::NoBrush));
  painter.drawRoundedRect(box, 2.5, 2.5);
  if (checked) {
    painter.setPen(QPen(Qt::white, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF{box.topLeft() + QPointF(3, 6.5), box.topLeft() + QPointF(5.6, 9.3),
                                   box.topLeft() + QPointF(10, 3.8)});
  }
  painter.restore();
}

QWidget* MeasurementDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem&,
                                           const QModelIndex& index) const {
  auto* editor = new QLineEdit(parent);
  editor->setFrame(false);
  editor->setAlignment(Qt::Alignment(index.data(Qt::TextAlignmentRole).toInt()));
  return editor;
}

bool MeasurementDelegate::eventFilter(QObject* object, QEvent* event) {
  if (event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Up || key == Qt::Key_Down) {
      auto* editor = static_cast<QWidget*>(object);
      QWidget* view = editor->parentWidget()->parentWidget();
      emit commitData(editor);
      emit closeEditor(editor, NoHint);
      QKeyEvent move(QEvent::KeyPress, key, Qt::NoModifier);
      QApplication::sendEvent(view, &move);
      return true;
    }
  }
  return QStyledItemDelegate::eventFilter(object, event);
}

bool MeasurementDelegate::editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                                      const QModelIndex& index) {
  if (index.column() != model_.voidColumn()) return QStyledItemDelegate::editorEvent(event, model, option, index);
  // A click anywhere in the cell, or Space.
  const bool click =
      event->type() == QEvent::MouseButtonRelease && static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton;
  const bool space = event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Space;
  if ((!click && !space) || !(index.flags() & Qt::ItemIsUserCheckable)) return false;
  const bool checked = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
  return model->setData(index, checked ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
}

}  // namespace btr::ui
