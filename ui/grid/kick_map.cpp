#include "ui/grid/kick_map.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/run/grid/grid_cells.h"
#include "ui/common/numbers/format.h"
#include "ui/grid/ramp.h"

namespace btr::ui {
namespace {

constexpr double mapLeft = 64, mapRight = 16, mapTop = 8, mapBottom = 74;

QColor colourOf(GridLoss loss) {
  switch (loss) {
    case GridLoss::none:
      return QColor(0x2e8b57);
    case GridLoss::direction:
      return QColor(0xf0c050);
    case GridLoss::distance:
      return QColor(0x3f7fd0);
    case GridLoss::balance:
      return QColor(0xc0392b);
    case GridLoss::trial:
      return QColor(0x505050);
  }
  return {};
}

QString nameOf(GridLoss loss) {
  switch (loss) {
    case GridLoss::none:
      return KickMap::tr("good");
    case GridLoss::direction:
      return KickMap::tr("loses direction");
    case GridLoss::distance:
      return KickMap::tr("loses distance");
    case GridLoss::balance:
      return KickMap::tr("loses balance");
    case GridLoss::trial:
      return KickMap::tr("did not finish");
  }
  return {};
}

/// Half way to the neighbours on an axis of even steps.
double halfStep(const std::vector<double>& axis) {
  return axis.size() > 1 ? (axis.back() - axis.front()) / static_cast<double>(axis.size() - 1) / 2 : 0.05;
}

}  // namespace

KickMap::KickMap(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Map of interpolated kicks"));
  setMouseTracking(true);
}

void KickMap::setMap(std::optional<GridMap> map) {
  map_ = std::move(map);
  losses_ = map_ ? lossesOf(*map_) : std::vector<GridLoss>();
  setShown(shown_);
}

QStringList KickMap::figures() const {
  std::set<QString> names;
  if (map_)
    for (const GridPoint& point : map_->points)
      for (const auto& [name, value] : point.figures) names.insert(QString::fromStdString(name));
  return {names.begin(), names.end()};
}

void KickMap::setShown(const QString& what) {
  shown_ = what;
  lowest_ = 0;
  highest_ = 0;
  if (map_)
    for (const GridPoint& point : map_->points)
      if (const auto value = valueOf(point)) highest_ = std::max(highest_, *value);
  if (!(highest_ > lowest_)) highest_ = lowest_ + 1;
  update();
}

void KickMap::setAxes(const std::vector<double>& bearings, const std::vector<double>& directions) {
  bearings_ = bearings;
  directions_ = directions;
  update();
}

void KickMap::setPoint(double bearing_rad, double direction_rad) {
  bearing_ = bearing_rad;
  direction_ = direction_rad;
  update();
}

/// Signed figures are painted by their size.
std::optional<double> KickMap::valueOf(const GridPoint& point) const {
  if (shown_.isEmpty()) return std::nullopt;
  if (shown_ == "fitness") return point.fitness;
  const auto found = point.figures.find(shown_.toStdString());
  if (found == point.figures.end()) return std::nullopt;
  return std::abs(found->second);
}

double KickMap::shareOf(GridLoss loss) const {
  if (losses_.empty()) return 0;
  return static_cast<double>(std::ranges::count(losses_, loss)) / static_cast<double>(losses_.size());
}

QRectF KickMap::frame() const {
  return {mapLeft, mapTop, std::max(10.0, width() - mapLeft - mapRight), std::max(10.0, height() - mapTop - mapBottom)};
}

QPointF KickMap::placeOf(double bearing, double direction) const {
  const auto& columns = map_ ? map_->bearings_rad : bearings_;
  const auto& rows = map_ ? map_->directions_rad : directions_;
  if (columns.empty() || rows.empty()) return frame().center();
  const double left = columns.back() + halfStep(columns), wide = left - columns.front() + halfStep(columns);
  const double top = rows.back() + halfStep(rows), high = top - rows.front() + halfStep(rows);
  return {frame().left() + frame().width() * (left - bearing) / wide,
          frame().top() + frame().height() * (top - direction) / high};
}

QRectF KickMap::boxOf(std::size_t point) const {
  const double dx = halfStep(map_->bearings_rad), dy = halfStep(map_->directions_rad);
  const auto& task = map_->points[point].task;
  return QRectF(placeOf(task[1] + dx, task[2] + dy), placeOf(task[1] - dx, task[2] - dy)).normalized();
}

std::optional<std::size_t> KickMap::pointAt(const QPointF& place) const {
  if (!map_) return std::nullopt;
  for (std::size_t k = 0; k < map_->points.size(); ++k)
    if (boxOf(k).contains(place)) return k;
  return std::nullopt;
}

QString KickMap::describe(std::size_t point) const {
  const GridPoint& p = map_->points.at(point);
  QString text = QString::fromStdString(nameOfTask(p.task)) + "\n" + nameOf(losses_[point]) +
                 tr(", fitness %1").arg(withUnit(p.fitness, QString::fromStdString(map_->unit)));
  for (const auto& [name, value] : p.figures)
    text += QStringLiteral("\n%1 %2").arg(QString::fromStdString(name), shortNumber(value));
  return text;
}

void KickMap::paintLegend(QPainter& painter) const {
  const double top = height() - mapBottom + 32;
  double x = 8, y = top;
  painter.setPen(palette().color(QPalette::Text));
  if (!shown_.isEmpty()) {
    const double wide = 160;
    for (int i = 0; i < wide; ++i) painter.fillRect(QRectF(x + i, y, 1.5, 12), rampColour(i / wide));
    painter.drawText(QRectF(x, y + 13, wide, 20), Qt::AlignLeft, shortNumber(lowest_));
    painter.drawText(QRectF(x, y + 13, wide, 20), Qt::AlignRight, shortNumber(highest_));
    painter.drawText(QRectF(x + wide + 12, y - 4, width() - wide - 30, 20), Qt::AlignLeft | Qt::AlignVCenter, shown_);
    return;
  }
  for (const GridLoss loss :
       {GridLoss::none, GridLoss::direction, GridLoss::distance, GridLoss::balance, GridLoss::trial}) {
    if (loss == GridLoss::trial && shareOf(loss) == 0) continue;
    const QString text = tr("%1 %2 %").arg(nameOf(loss)).arg(std::round(100 * shareOf(loss)));
    const double wide = 22 + fontMetrics().horizontalAdvance(text) + 12;
    if (x + wide > width() && x > 8) {
      x = 8;
      y += 19;
    }
    painter.fillRect(QRectF(x, y, 14, 12), colourOf(loss));
    painter.drawText(QRectF(x + 19, y - 4, wide, 20), Qt::AlignLeft | Qt::AlignVCenter, text);
    x += wide;
  }
}

void KickMap::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().base());
  if (!map_) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(frame(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("“Compute map” tries interpolated kicks between the cells"));
  } else {
    for (std::size_t k = 0; k < map_->points.size(); ++k) {
      QColor colour = colourOf(losses_[k]);
      if (!shown_.isEmpty()) {
        const auto value = valueOf(map_->points[k]);
        colour = value ? rampColour((*value - lowest_) / (highest_ - lowest_)) : palette().color(QPalette::Mid);
      }
      painter.fillRect(boxOf(k), colour);
    }
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(palette().color(QPalette::Text));
  painter.setBrush(Qt::NoBrush);
  for (const double b : bearings_)
    painter.drawText(QRectF(placeOf(b, 0).x() - 50, frame().bottom() + 3, 100, 20), Qt::AlignCenter,
                     tr("β %1").arg(degrees(b)));
  for (const double a : directions_)
    painter.drawText(QRectF(0, placeOf(0, a).y() - 10, mapLeft - 4, 20), Qt::AlignRight | Qt::AlignVCenter,
                     tr("α %1").arg(degrees(a)));
  // Rings where cells are; the cross is the point of the preview.
  for (const double b : bearings_)
    for (const double a : directions_) {
      painter.setPen(QPen(Qt::black, 3));
      painter.drawEllipse(placeOf(b, a), 5, 5);
      painter.setPen(QPen(Qt::white, 1.5));
      painter.drawEllipse(placeOf(b, a), 5, 5);
    }
  const QPointF at = placeOf(bearing_, direction_);
  for (const auto& [colour, thick] : {std::pair(QColor(Qt::black), 4.0), std::pair(QColor(Qt::white), 2.0)}) {
    painter.setPen(QPen(colour, thick));
    painter.drawLine(at - QPointF(9, 0), at + QPointF(9, 0));
    painter.drawLine(at - QPointF(0, 9), at + QPointF(0, 9));
  }
  if (map_) paintLegend(painter);
}

void KickMap::mousePressEvent(QMouseEvent* event) {
  if (const auto point = pointAt(event->position())) {
    const auto& task = map_->points[*point].task;
    setPoint(task[1], task[2]);
    emit chosen(task[1], task[2]);
  }
}

bool KickMap::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  if (const auto point = pointAt(help->pos()))
    QToolTip::showText(help->globalPos(), describe(*point), this);
  else
    QToolTip::hideText();
  return true;
}

}  // namespace btr::ui
