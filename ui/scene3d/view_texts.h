#pragma once
#include <QFontMetrics>
#include <QList>
#include <QRect>
#include <QSize>
#include <QString>
#include <QStringList>

class QPainter;

namespace btr::ui {

struct Badge {
  enum class Tone { good, bad, warning, standIn, neutral };
  QString text;
  Tone tone = Tone::neutral;
};

/// Where the texts of a view stand: the caption in the upper left corner, the badges in the upper right one, topmost
/// first. In a narrow view the badges move below the caption, and what is still too long ends in "…": nothing lies upon
/// anything else.
struct ViewTexts {
  QStringList captionLines;
  QRect caption;  ///< empty: none
  QStringList badgeTexts;
  QList<QRect> badges;
};
ViewTexts layoutTexts(const QFontMetrics& metrics, const QSize& size, const QStringList& caption,
                      const QList<Badge>& badges);

void drawTexts(QPainter& painter, const QSize& size, const QStringList& caption, const QList<Badge>& badges);

}  // namespace btr::ui
