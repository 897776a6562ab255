#include "ui/common/look/short_label.h"

#include <QEvent>

namespace btr::ui {

void ShortLabel::setTexts(const QString& whole, const QString& brief, const QString& hint) {
  if (whole == whole_ && brief == brief_ && hint == hint_) return;
  whole_ = whole;
  brief_ = brief;
  hint_ = hint;
  setAccessibleName(whole);
  setText(whole);
  updateGeometry();
  // By then the layout has given it the width that it wants, or not.
  QMetaObject::invokeMethod(this, &ShortLabel::choose, Qt::QueuedConnection);
}

void ShortLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  choose();
}

// Another font or style sheet needs another width.
void ShortLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) choose();
}

void ShortLabel::choose() {
  const bool fits = sizeOf(whole_).width() <= width();
  setText(fits ? whole_ : brief_);
  setToolTip(fits ? hint_ : hint_.isEmpty() ? whole_ : whole_ + '\n' + hint_);
}

QSize ShortLabel::sizeOf(const QString& text) const {
  // With the frame and the padding that a style gives it.
  const QSize now = QLabel::sizeHint();
  const auto width = [this](const QString& of) { return fontMetrics().horizontalAdvance(of); };
  return {now.width() - width(QLabel::text()) + width(text), now.height()};
}

}  // namespace btr::ui
