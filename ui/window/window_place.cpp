#include "ui/window/window_place.h"

#include <QEvent>
#include <QMainWindow>
#include <QScreen>
#include <QTimer>

#include "ui/common/settings.h"
#include "ui/window/dock_layout.h"

namespace btr::ui {

WindowPlace::WindowPlace(QMainWindow& window, DockLayout& layout, Settings& settings)
    : QObject(&window), window_(window), layout_(layout), settings_(settings) {
  window_.installEventFilter(this);
}

/// The screen less what a window manager's frame and title take.
QSize WindowPlace::defaultSize() const {
  const bool isFramed = window_.isVisible() && window_.frameSize() != window_.size();
  const QSize frame = isFramed ? window_.frameSize() - window_.size() : QSize(16, 44);
  return QSize(1600, 1000).boundedTo(window_.screen()->availableSize() - frame);
}

void WindowPlace::restore() {
  window_.resize(defaultSize());
  if (const QByteArray geometry = settings_.geometry(); !geometry.isEmpty()) window_.restoreGeometry(geometry);
  layout_.arrange();
  if (const QByteArray layout = settings_.layout(); !layout.isEmpty()) layout_.restore(layout);
}

void WindowPlace::reset() {
  if (!window_.isMaximized() && !window_.isFullScreen()) window_.resize(defaultSize());
  layout_.arrange();
}

void WindowPlace::keep() { settings_.setWindow(window_.saveGeometry(), layout_.state()); }

// Only once it is shown is it known how large the frame is.
bool WindowPlace::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Show)
    QTimer::singleShot(0, this, [this] {
      bringOnScreen();
      layout_.sizeOnce();
    });
  return QObject::eventFilter(watched, event);
}

void WindowPlace::bringOnScreen() {
  if (window_.isMaximized() || window_.isFullScreen()) return;
  const QRect room = window_.screen()->availableGeometry();
  const QSize most = room.size() - (window_.frameSize() - window_.size());
  if (window_.width() > most.width() || window_.height() > most.height())
    window_.resize(window_.size().boundedTo(most));
  if (!room.contains(window_.frameGeometry().topLeft())) window_.move(room.topLeft());
}

}  // namespace btr::ui
