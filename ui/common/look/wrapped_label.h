#pragma once
#include <QLabel>
#include <QResizeEvent>

namespace btr::ui {

/// A label of several lines that asks for the height that they need at its width: none is cut where layouts go by the
/// least size alone, as splitters and scrolled pages do.
class WrappedLabel : public QLabel {
 public:
  explicit WrappedLabel(QWidget* parent) : QLabel(parent) { setWordWrap(true); }
  QSize minimumSizeHint() const override {
    return {QLabel::minimumSizeHint().width(), text().isEmpty() ? 0 : heightForWidth(width())};
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QLabel::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) updateGeometry();
  }
};

}  // namespace btr::ui
