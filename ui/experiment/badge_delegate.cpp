#include "ui/experiment/badge_delegate.h"

#include <QPainter>

#include "ui/common/theme.h"

namespace btr::ui {
namespace {

QFont badgeFont(const QFont& font) {
  QFont small = font;
  small.setPointSizeF(font.pointSizeF() * 0.82);
  return small;
}

}  // namespace

void BadgeDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QString badge = index.data(BadgeRole).toString();
  if (badge.isEmpty()) return QStyledItemDelegate::paint(painter, option, index);

  // The text keeps what the badge leaves.
  const QFont font = badgeFont(option.font);
  const int width = QFontMetrics(font).horizontalAdvance(badge) + 12;
  QStyleOptionViewItem item = option;
  QStyledItemDelegate::paint(painter, item, index);

  const QColor tone = tonesOf(option.palette).standIn;
  const bool selected = option.state.testFlag(QStyle::State_Selected);
  const int textWidth =
      option.fontMetrics.horizontalAdvance(index.data().toString()) + option.decorationSize.width() + 16;
  const int height = QFontMetrics(font).height() + 2;
  const int left = option.rect.left() + qMin(textWidth, qMax(0, option.rect.width() - width - 4));
  const QRectF pill(left + 0.5, option.rect.center().y() - height / 2 + 0.5, width - 1, height - 1);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(selected ? option.palette.color(QPalette::HighlightedText) : tone);
  QColor fill = selected ? option.palette.color(QPalette::Highlight) : option.palette.color(QPalette::Base);
  painter->setBrush(fill);
  painter->drawRoundedRect(pill, height / 2.0, height / 2.0);
  painter->setFont(font);
  painter->drawText(pill, Qt::AlignCenter, badge);
  painter->restore();
}

QSize BadgeDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  QSize size = QStyledItemDelegate::sizeHint(option, index);
  size.setHeight(qMax(size.height(), option.fontMetrics.height() + 8));
  if (const QString badge = index.data(BadgeRole).toString(); !badge.isEmpty())
    size.rwidth() += QFontMetrics(badgeFont(option.font)).horizontalAdvance(badge) + 20;
  return size;
}

}  // namespace btr::ui
