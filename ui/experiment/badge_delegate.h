#pragma once
#include <QStyledItemDelegate>

namespace btr::ui {

/// Paints an item with a rounded badge after its text (BadgeRole) and a second, paler line below it (DetailRole).
class BadgeDelegate : public QStyledItemDelegate {
 public:
  static constexpr int BadgeRole = Qt::UserRole + 40;
  static constexpr int DetailRole = Qt::UserRole + 41;
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

}  // namespace btr::ui
