#include "ui/experiment/badge_delegate.h"

#include <QApplication>
#include <QPainter>

#include "ui/common/theme.h"

namespace btr::ui {
namespace {

constexpr int gap = 6;

QFont smaller(const QFont& font) {
  QFont small = font;
  small.setPointSizeF(font.pointSizeF() * 0.85);
  return small;
}

}  // namespace

void BadgeDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  QStyleOptionViewItem item = option;
  initStyleOption(&item, index);
  const QString text = item.text;
  const QIcon icon = item.icon;
  item.text.clear();
  item.icon = {};
  item.features &= ~QStyleOptionViewItem::HasDecoration;
  QApplication::style()->drawControl(QStyle::CE_ItemViewItem, &item, painter, option.widget);

  painter->save();
  const bool selected = option.state.testFlag(QStyle::State_Selected);
  const QColor pen = option.palette.color(selected ? QPalette::HighlightedText : QPalette::Text);
  const QString badge = index.data(BadgeRole).toString(), detail = index.data(DetailRole).toString();
  const QFont font = item.font, small = smaller(font);
  const QFontMetrics metrics(font), smallMetrics(small);
  QRect rect = option.rect.adjusted(3, 0, -3, 0);
  const int iconSize = option.decorationSize.width();
  if (!icon.isNull()) icon.paint(painter, QRect(rect.left(), rect.center().y() - iconSize / 2, iconSize, iconSize));
  rect.setLeft(rect.left() + iconSize + gap);

  // First line: the text keeps what the badge leaves.
  const int badgeWidth = badge.isEmpty() ? 0 : smallMetrics.horizontalAdvance(badge) + 12;
  const int lines = metrics.height() + (detail.isEmpty() ? 0 : smallMetrics.height());
  const int top = rect.center().y() - lines / 2;
  const QString shown =
      metrics.elidedText(text, Qt::ElideRight, qMax(0, rect.width() - badgeWidth - (badgeWidth ? gap : 0)));
  painter->setFont(font);
  painter->setPen(pen);
  painter->drawText(QRect(rect.left(), top, rect.width(), metrics.height()), Qt::AlignLeft | Qt::AlignVCenter, shown);
  painter->setFont(small);
  if (!badge.isEmpty()) {
    const QColor tone = selected ? pen : tonesOf(option.palette).standIn;
    const QRectF pill(rect.left() + metrics.horizontalAdvance(shown) + gap + 0.5,
                      top + (metrics.height() - smallMetrics.height()) / 2 + 0.5, badgeWidth - 1,
                      smallMetrics.height() - 1);
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(tone);
    painter->setBrush(Qt::NoBrush);
    painter->drawRoundedRect(pill, pill.height() / 2, pill.height() / 2);
    painter->drawText(pill, Qt::AlignCenter, badge);
  }
  if (!detail.isEmpty()) {
    painter->setPen(selected ? pen : tonesOf(option.palette).muted);
    painter->drawText(QRect(rect.left(), top + metrics.height(), rect.width(), smallMetrics.height()),
                      Qt::AlignLeft | Qt::AlignVCenter, smallMetrics.elidedText(detail, Qt::ElideRight, rect.width()));
  }
  painter->restore();
}

QSize BadgeDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QFontMetrics metrics(option.font), smallMetrics(smaller(option.font));
  const QString badge = index.data(BadgeRole).toString(), detail = index.data(DetailRole).toString();
  int width = metrics.horizontalAdvance(index.data().toString()) + option.decorationSize.width() + 2 * gap + 6;
  if (!badge.isEmpty()) width += smallMetrics.horizontalAdvance(badge) + 12 + gap;
  return {width, metrics.height() + 8 + (detail.isEmpty() ? 0 : smallMetrics.height())};
}

}  // namespace btr::ui
