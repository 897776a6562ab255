#pragma once
#include <QLabel>
#include <QResizeEvent>

#include "ui/common/look/plain_tip.h"

namespace btr::ui {

/// A label of one line that makes no window wider: what does not fit is left out behind "…", and its tool tip has all.
class CutLabel : public QLabel {
 public:
  explicit CutLabel(QWidget* parent) : QLabel(parent) {
    setTextFormat(Qt::PlainText);
    setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  }
  void setWhole(const QString& whole) {
    whole_ = whole;
    setToolTip(plainTip(whole));
    setAccessibleName(whole);
    cut();
  }
  QString whole() const { return whole_; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QLabel::resizeEvent(event);
    cut();
  }

 private:
  void cut() { setText(fontMetrics().elidedText(whole_, Qt::ElideRight, contentsRect().width())); }

  QString whole_;
};

}  // namespace btr::ui
