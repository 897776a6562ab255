#pragma once
#include <QRect>
#include <QStyledItemDelegate>

namespace btr::ui {

/// Paints an item with a rounded badge after its text (BadgeRole) and a second, paler line below it (DetailRole). Where
/// the line is too short for both, the badge goes down before the detail: it never takes the text's place.
class BadgeDelegate : public QStyledItemDelegate {
 public:
  static constexpr int BadgeRole = Qt::UserRole + 40;
  static constexpr int DetailRole = Qt::UserRole + 41;
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

  /// What is painted where, in the view's coordinates; text and detail as they are shown.
  struct Places {
    QString text, detail;
    QRect textAt, badgeAt, detailAt;
  };
  static Places placesOf(const QStyleOptionViewItem& option, const QModelIndex& index);
};

}  // namespace btr::ui
