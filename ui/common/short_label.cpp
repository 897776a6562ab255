#include "ui/common/short_label.h"

namespace btr::ui {

void ShortLabel::setTexts(const QString& whole, const QString& brief) {
  whole_ = whole;
  brief_ = brief;
  setAccessibleName(whole);
  updateGeometry();
  choose();
}

void ShortLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  choose();
}

void ShortLabel::choose() {
  const bool fits = sizeOf(whole_).width() <= width();
  setText(fits ? whole_ : brief_);
  setToolTip(fits ? QString() : whole_);
}

QSize ShortLabel::sizeOf(const QString& text) const {
  return QSize(fontMetrics().horizontalAdvance(text), fontMetrics().height()).grownBy(contentsMargins());
}

}  // namespace btr::ui
