#pragma once
#include <QStyledItemDelegate>

#include "ui/measure/measurement_model.h"

namespace btr::ui {

/// Draws and edits the sheet's cells: a red frame around what is not allowed, selected or not; the void box in the
/// middle of its cell; up and down leave the editor and move, as in a spreadsheet.
class MeasurementDelegate final : public QStyledItemDelegate {
  Q_OBJECT

 public:
  MeasurementDelegate(const MeasurementModel& model, QObject* parent);

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  bool eventFilter(QObject* object, QEvent* event) override;
  bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                   const QModelIndex& index) override;

 private:
  void paintBox(QPainter& painter, const QStyleOptionViewItem& option, const QModelIndex& index) const;

  const MeasurementModel& model_;
};

}  // namespace btr::ui
