#pragma once
#include <QSlider>
#include <vector>

#include "ui/live/live_process.h"

namespace btr::ui {

/// A slider over a session's control periods with a stroke where each of its acts was. A click goes there at once;
/// valueChanged() comes when the mouse lets go, or with a key.
class ActTimeline : public QSlider {
  Q_OBJECT
 public:
  explicit ActTimeline(QWidget* parent = nullptr);

  void setActs(std::vector<LoggedActs> acts, double period_s);
  /// As the session is now; not while somebody drags. No signal.
  void showPeriod(long period);
  /// "3.20 s: move ball" of what is under the mouse there, else "".
  QString textAt(const QPoint& place) const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  /// Of the middle of the handle.
  int xOf(long period) const;
  int valueAt(int x) const;

  std::vector<LoggedActs> acts_;
  double period_s_ = 1;
};

}  // namespace btr::ui
