#pragma once
#include <QStyledItemDelegate>

namespace btr::ui {

/// Paints a rounded badge after the text of items that have one in BadgeRole.
class BadgeDelegate : public QStyledItemDelegate {
 public:
  static constexpr int BadgeRole = Qt::UserRole + 40;
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

}  // namespace btr::ui
