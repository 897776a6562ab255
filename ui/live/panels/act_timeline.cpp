#include "ui/live/panels/act_timeline.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QSignalBlocker>
#include <QStyle>
#include <QToolTip>
#include <algorithm>
#include <cstdlib>
#include <utility>

#include "ui/common/look/theme.h"

namespace btr::ui {
namespace {
constexpr int margin_px = 8;  ///< left and right of the strokes
}

ActTimeline::ActTimeline(QWidget* parent) : QSlider(Qt::Horizontal, parent) {
  setTracking(false);
  setMinimumHeight(26);
}

void ActTimeline::setActs(std::vector<LoggedActs> acts, double period_s) {
  acts_ = std::move(acts);
  period_s_ = period_s;
  update();
}

void ActTimeline::showPeriod(long period) {
  if (isSliderDown()) return;
  const QSignalBlocker quiet(this);
  setValue(static_cast<int>(period));
}

int ActTimeline::xOf(long period) const {
  return margin_px + QStyle::sliderPositionFromValue(minimum(), maximum(), static_cast<int>(period),
                                                     std::max(1, width() - 2 * margin_px));
}

int ActTimeline::valueAt(int x) const {
  return QStyle::sliderValueFromPosition(minimum(), maximum(), x - margin_px, std::max(1, width() - 2 * margin_px));
}

QString ActTimeline::textAt(const QPoint& place) const {
  constexpr int near_px = 4;
  QStringList all;
  for (const LoggedActs& act : acts_)
    if (place.x() >= xOf(act.from) - near_px && place.x() <= xOf(act.to) + near_px)
      all << tr("%1 s: %2").arg(static_cast<double>(act.from) * period_s_, 0, 'f', 2).arg(act.name);
  constexpr qsizetype most = 8;
  if (all.size() > most) all = all.mid(0, most) << tr("…");
  return all.join('\n');
}

void ActTimeline::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Tones tones = tonesOf(palette());
  const int middle = height() / 2, right = xOf(maximum());
  const int at = xOf(sliderPosition());
  painter.fillRect(QRect(margin_px, middle - 2, right - margin_px, 4), palette().color(QPalette::Mid));
  painter.fillRect(QRect(margin_px, middle - 2, at - margin_px, 4), palette().color(QPalette::Highlight));
  for (const LoggedActs& act : acts_) {
    const int from = xOf(act.from), to = xOf(act.to);
    painter.fillRect(QRect(from - 1, middle - 9, std::max(2, to - from), 18), tones.warning);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Highlight : QPalette::Dark), hasFocus() ? 2 : 1));
  painter.setBrush(palette().color(isEnabled() ? QPalette::Button : QPalette::Window));
  painter.drawRoundedRect(QRectF(at - 5.5, middle - 10.5, 11, 21), 3, 3);
}

void ActTimeline::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  setSliderDown(true);
  setSliderPosition(valueAt(event->position().toPoint().x()));
}

void ActTimeline::mouseMoveEvent(QMouseEvent* event) {
  if (isSliderDown()) setSliderPosition(valueAt(event->position().toPoint().x()));
}

void ActTimeline::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && isSliderDown()) setSliderDown(false);
}

bool ActTimeline::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QSlider::event(event);
  auto* help = static_cast<QHelpEvent*>(event);
  const QString text = textAt(help->pos());
  QToolTip::showText(help->globalPos(), text.isEmpty() ? toolTip() : text, this);
  return true;
}

}  // namespace btr::ui
