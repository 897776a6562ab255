#include "ui/window/scroll_page.h"

#include <QEvent>
#include <QScrollBar>
#include <QStyle>

namespace btr::ui {
namespace {
constexpr QSize leastSize{160, 72};
}

ScrollPage::ScrollPage(QWidget* content, QWidget* parent) : QScrollArea(parent) {
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  setWidget(content);
  content->installEventFilter(this);
}

QSize ScrollPage::sizeHint() const { return widget()->sizeHint(); }

QSize ScrollPage::minimumSizeHint() const {
  return widget()->minimumSizeHint().expandedTo(widget()->minimumSize()).boundedTo(leastSize);
}

// A scroll bar takes room of its own, which may make the other one necessary.
void ScrollPage::fit() {
  const int bar = style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, this);
  // Not by height for width: pages of a tab widget would ask for what they would like, not for what they need.
  const QSize least = widget()->minimumSizeHint().expandedTo(widget()->minimumSize());
  QSize room = maximumViewportSize();
  const bool tall = least.height() > room.height();
  if (tall) room.rwidth() -= bar;
  if (least.width() > room.width()) room.rheight() -= bar;
  widget()->resize(room.expandedTo(least));
}

void ScrollPage::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  fit();
}

bool ScrollPage::eventFilter(QObject* watched, QEvent* event) {
  const bool result = QScrollArea::eventFilter(watched, event);
  if (watched == widget() && event->type() == QEvent::LayoutRequest) {
    fit();
    updateGeometry();
  }
  return result;
}

}  // namespace btr::ui
