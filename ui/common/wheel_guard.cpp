#include "ui/common/wheel_guard.h"

#include <QAbstractScrollArea>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QEvent>
#include <QScrollArea>
#include <QScrollBar>

namespace btr::ui {
namespace {

/// The field that the wheel would change, or nullptr; the line of a spin box belongs to it.
QWidget* fieldOf(QObject* watched) {
  for (auto* widget = qobject_cast<QWidget*>(watched); widget && !widget->isWindow(); widget = widget->parentWidget()) {
    if (qobject_cast<QComboBox*>(widget) || qobject_cast<QAbstractSpinBox*>(widget)) return widget;
    if (qobject_cast<QAbstractSlider*>(widget)) return qobject_cast<QScrollBar*>(widget) ? nullptr : widget;
    if (qobject_cast<QAbstractScrollArea*>(widget)) return nullptr;
  }
  return nullptr;
}

bool isInScrollArea(const QWidget* widget) {
  for (; widget; widget = widget->parentWidget())
    if (qobject_cast<const QScrollArea*>(widget)) return true;
  return false;
}

}  // namespace

WheelGuard::WheelGuard(QObject* parent) : QObject(parent) {}

void WheelGuard::ensure() {
  QCoreApplication* application = QCoreApplication::instance();
  if (!application || application->findChild<WheelGuard*>(QString(), Qt::FindDirectChildrenOnly)) return;
  application->installEventFilter(new WheelGuard(application));
}

// Not taken by the field, the event goes on to its parents: the scroll area among them.
bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Wheel) return false;
  const QWidget* field = fieldOf(watched);
  if (!field || !isInScrollArea(field)) return false;
  event->ignore();
  return true;
}

}  // namespace btr::ui
