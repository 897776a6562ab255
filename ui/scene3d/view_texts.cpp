#include "ui/scene3d/view_texts.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

namespace btr::ui {
namespace {

QColor toneColour(Badge::Tone tone) {
  switch (tone) {
    case Badge::Tone::good:
      return QColor(34, 125, 62);
    case Badge::Tone::bad:
      return QColor(180, 35, 40);
    case Badge::Tone::warning:
      return QColor(150, 92, 0);
    case Badge::Tone::standIn:
      return QColor(123, 63, 181);
    case Badge::Tone::neutral:
      return QColor(90, 96, 105);
  }
  return {};
}

int padOf(const QFontMetrics& metrics) { return metrics.height() / 3; }

}  // namespace

ViewTexts layoutTexts(const QFontMetrics& metrics, const QSize& size, const QStringList& caption,
                      const QList<Badge>& badges) {
  ViewTexts texts;
  const int pad = padOf(metrics), margin = metrics.height() / 2;
  const int most = std::max(0, size.width() - 2 * margin - 4 * pad);
  int width = 0;
  for (const QString& line : caption) {
    texts.captionLines << metrics.elidedText(line, Qt::ElideRight, most);
    width = std::max(width, metrics.horizontalAdvance(texts.captionLines.last()));
  }
  if (!caption.isEmpty())
    texts.caption =
        QRect(margin, margin, width + 4 * pad, metrics.height() * static_cast<int>(caption.size()) + 2 * pad);

  int widest = 0;
  for (const Badge& badge : badges) {
    texts.badgeTexts << metrics.elidedText(badge.text, Qt::ElideRight, most);
    widest = std::max(widest, metrics.horizontalAdvance(texts.badgeTexts.last()) + 4 * pad);
  }
  const bool beside = caption.isEmpty() || texts.caption.right() + margin + widest + margin <= size.width();
  int y = beside ? margin : texts.caption.bottom() + 1 + pad;
  for (const QString& text : texts.badgeTexts) {
    const int wide = metrics.horizontalAdvance(text) + 4 * pad;
    texts.badges << QRect(size.width() - wide - margin, y, wide, metrics.height() + 2 * pad);
    y += metrics.height() + 3 * pad;
  }
  return texts;
}

void drawTexts(QPainter& painter, const QSize& size, const QStringList& caption, const QList<Badge>& badges) {
  painter.setRenderHint(QPainter::Antialiasing);
  const ViewTexts texts = layoutTexts(QFontMetrics(painter.font()), size, caption, badges);
  const int pad = padOf(QFontMetrics(painter.font()));
  const auto plate = [&](const QRect& area, const QColor& colour) {
    QPainterPath path;
    path.addRoundedRect(area, pad + 2, pad + 2);
    painter.fillPath(path, colour);
    painter.setPen(Qt::white);
  };
  if (!texts.caption.isEmpty()) {
    plate(texts.caption, QColor(20, 24, 30, 150));
    painter.drawText(texts.caption.adjusted(2 * pad, pad, -2 * pad, -pad), Qt::AlignLeft | Qt::AlignTop,
                     texts.captionLines.join('\n'));
  }
  for (int i = 0; i < badges.size(); ++i) {
    plate(texts.badges[i], toneColour(badges[i].tone));
    painter.drawText(texts.badges[i], Qt::AlignCenter, texts.badgeTexts[i]);
  }
}

}  // namespace btr::ui
