#include "ui/experiment/badge_delegate.h"

#include <QApplication>
#include <QPainter>

#include "ui/common/look/theme.h"

namespace btr::ui {
namespace {

constexpr int gap = 6, margin = 3;

QFont smaller(const QFont& font) {
  QFont small = font;
  small.setPointSizeF(font.pointSizeF() * 0.85);
  return small;
}

int badgeWidthOf(const QString& badge, const QFontMetrics& metrics) { return metrics.horizontalAdvance(badge) + 12; }

}  // namespace

BadgeDelegate::Places BadgeDelegate::placesOf(const QStyleOptionViewItem& option, const QModelIndex& index) {
  const QString text = index.data().toString(), badge = index.data(BadgeRole).toString(),
                detail = index.data(DetailRole).toString();
  const QFontMetrics metrics(option.font), smallMetrics(smaller(option.font));
  const int left = option.rect.left() + margin + option.decorationSize.width() + gap;
  const int room = qMax(0, option.rect.right() - margin + 1 - left);
  const int lines = metrics.height() + (detail.isEmpty() ? 0 : smallMetrics.height());
  const QRect first(left, option.rect.center().y() - lines / 2, room, metrics.height());
  QRect second(left, first.bottom() + 1, room, smallMetrics.height());

  const int badgeWidth = badge.isEmpty() ? 0 : badgeWidthOf(badge, smallMetrics), beside = badgeWidth + gap;
  const bool isBelow = badgeWidth > 0 && !detail.isEmpty() && metrics.horizontalAdvance(text) > room - beside;
  Places places;
  places.text = metrics.elidedText(text, Qt::ElideRight, badgeWidth > 0 && !isBelow ? qMax(0, room - beside) : room);
  places.textAt = first;
  if (badgeWidth > 0)
    places.badgeAt = isBelow ? QRect(left, second.top(), badgeWidth, smallMetrics.height())
                             : QRect(left + metrics.horizontalAdvance(places.text) + gap,
                                     first.top() + (metrics.height() - smallMetrics.height()) / 2, badgeWidth,
                                     smallMetrics.height());
  if (isBelow) second.setLeft(qMin(second.left() + beside, second.right() + 1));
  places.detail = smallMetrics.elidedText(detail, Qt::ElideRight, second.width());
  places.detailAt = second;
  return places;
}

void BadgeDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  QStyleOptionViewItem item = option;
  initStyleOption(&item, index);
  const Places places = placesOf(item, index);
  const QIcon icon = item.icon;
  item.text.clear();
  item.icon = {};
  item.features &= ~QStyleOptionViewItem::HasDecoration;
  QApplication::style()->drawControl(QStyle::CE_ItemViewItem, &item, painter, option.widget);

  painter->save();
  const bool selected = option.state.testFlag(QStyle::State_Selected);
  const QColor pen = option.palette.color(selected ? QPalette::HighlightedText : QPalette::Text);
  const int iconSize = option.decorationSize.width();
  if (!icon.isNull())
    icon.paint(painter,
               QRect(option.rect.left() + margin, option.rect.center().y() - iconSize / 2, iconSize, iconSize));
  painter->setFont(item.font);
  painter->setPen(pen);
  painter->drawText(places.textAt, Qt::AlignLeft | Qt::AlignVCenter, places.text);
  painter->setFont(smaller(item.font));
  if (!places.badgeAt.isEmpty()) {
    const QColor tone = selected ? pen : tonesOf(option.palette).standIn;
    const QRectF pill = QRectF(places.badgeAt).adjusted(0.5, 0.5, -0.5, -0.5);
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(tone);
    painter->setBrush(Qt::NoBrush);
    painter->drawRoundedRect(pill, pill.height() / 2, pill.height() / 2);
    painter->drawText(pill, Qt::AlignCenter, index.data(BadgeRole).toString());
  }
  painter->setPen(selected ? pen : tonesOf(option.palette).muted);
  painter->drawText(places.detailAt, Qt::AlignLeft | Qt::AlignVCenter, places.detail);
  painter->restore();
}

QSize BadgeDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QFontMetrics metrics(option.font), smallMetrics(smaller(option.font));
  const QString badge = index.data(BadgeRole).toString(), detail = index.data(DetailRole).toString();
  int width = metrics.horizontalAdvance(index.data().toString()) + option.decorationSize.width() + 2 * gap + 2 * margin;
  if (!badge.isEmpty()) width += badgeWidthOf(badge, smallMetrics) + gap;
  return {width, metrics.height() + 8 + (detail.isEmpty() ? 0 : smallMetrics.height())};
}

}  // namespace btr::ui
