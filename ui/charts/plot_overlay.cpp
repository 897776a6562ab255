#include "ui/charts/plot_overlay.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace btr::ui {

PlotOverlay::PlotOverlay(const PlotData& data, const std::set<QString>& hidden,
                         std::function<QPointF(QPointF)> toPosition, QGraphicsItem* parent)
    : QGraphicsItem(parent), data_(data), hidden_(hidden), toPosition_(std::move(toPosition)) {
  setZValue(100);
  setAcceptedMouseButtons(Qt::NoButton);
}

void PlotOverlay::setArea(const QRectF& plotArea) {
  prepareGeometryChange();
  area_ = plotArea;
}

void PlotOverlay::setColours(const PlotColours& colours) {
  colours_ = colours;
  update();
}

void PlotOverlay::setFont(const QFont& font) {
  font_ = font;
  update();
}

void PlotOverlay::setReadOut(std::optional<ReadOut> readOut) {
  readOut_ = std::move(readOut);
  update();
}

QRectF PlotOverlay::boundingRect() const { return area_.adjusted(-2, -2, 2, 2); }

void PlotOverlay::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  if (area_.isEmpty()) return;
  painter->save();
  painter->setClipRect(area_.adjusted(-1, -1, 1, 1));
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setFont(font_);
  paintMarkers(*painter);
  paintSegments(*painter);
  paintErrorBars(*painter);
  paintReadOut(*painter);

  const bool anyPoint =
      std::any_of(data_.series.begin(), data_.series.end(), [](auto& s) { return !s.points.empty(); });
  if (!anyPoint && data_.bands.empty()) {
    painter->setPen(colours_.faintText);
    painter->drawText(area_, Qt::AlignCenter | Qt::TextWordWrap, data_.empty);
  }
  painter->restore();
}

void PlotOverlay::paintMarkers(QPainter& painter) const {
  const QFontMetricsF metrics(font_);
  painter.setPen(QPen(colours_.faintText, 1.2, Qt::DashLine));
  for (const PlotMarker& marker : data_.markers) {
    const double x = toPosition_({marker.x, 0}).x();
    painter.drawLine(QPointF(x, area_.top()), QPointF(x, area_.bottom()));
  }
  // Labels stand right of their line, in the first row where they cover no other label.
  // They take a third of the plot at most: a label without room is left out, its line stays.
  std::vector<double> rowEnds;
  const auto mostRows = static_cast<std::ptrdiff_t>(std::max(1.0, area_.height() / 3 / metrics.height()));
  for (const PlotMarker& marker : data_.markers) {
    const double x = toPosition_({marker.x, 0}).x();
    if (!(x >= area_.left() - 1 && x <= area_.right() + 1)) continue;
    const double width = metrics.horizontalAdvance(marker.label);
    const double left = x + 4 + width > area_.right() ? x - 4 - width : x + 4;
    const auto row = std::find_if(rowEnds.begin(), rowEnds.end(), [&](double end) { return end < left - 6; });
    const auto index = row - rowEnds.begin();
    if (index >= mostRows) continue;
    if (row == rowEnds.end()) rowEnds.push_back(0);
    rowEnds[static_cast<std::size_t>(index)] = left + width;
    const QRectF box(left, area_.top() + 2 + static_cast<double>(index) * metrics.height(), width, metrics.height());
    QColor behind = colours_.background;
    behind.setAlphaF(0.8F);
    painter.fillRect(box.adjusted(-2, 0, 2, 0), behind);
    painter.setPen(colours_.faintText);
    painter.drawText(box, Qt::AlignLeft | Qt::AlignVCenter, marker.label);
  }
}

void PlotOverlay::paintSegments(QPainter& painter) const {
  for (const PlotSegment& segment : data_.segments) {
    if (!isShown(segment.series)) continue;
    const auto owner = std::find_if(data_.series.begin(), data_.series.end(),
                                    [&](const PlotSeries& series) { return series.name == segment.series; });
    QColor colour = owner == data_.series.end() ? colours_.faintText : colours_.series(owner->colour);
    colour.setAlphaF(0.6F);
    painter.setPen(QPen(colour, 2));
    painter.drawLine(toPosition_(segment.from), toPosition_(segment.to));
  }
}

void PlotOverlay::paintErrorBars(QPainter& painter) const {
  constexpr double cap = 4;
  for (const PlotSeries& series : data_.series) {
    if (!isShown(series.name)) continue;
    painter.setPen(QPen(colours_.series(series.colour), 1.4));
    for (std::size_t i = 0; i < std::min(series.errors.size(), series.points.size()); ++i) {
      const double error = series.errors[i];
      if (!(error > 0)) continue;
      QPointF end = series.drawnAt(i) - QPointF(0, error);
      if (data_.neverNegative) end.setY(std::max(end.y(), 0.0));
      const QPointF low = toPosition_(end);
      const QPointF high = toPosition_(series.drawnAt(i) + QPointF(0, error));
      // On a logarithmic axis the lower end may lie below every number.
      const double bottom = std::isfinite(low.y()) ? low.y() : area_.bottom();
      if (!std::isfinite(high.y()) || !std::isfinite(high.x())) continue;
      painter.drawLine(QPointF(high.x(), bottom), high);
      painter.drawLine(high - QPointF(cap, 0), high + QPointF(cap, 0));
      painter.drawLine(QPointF(high.x() - cap, bottom), QPointF(high.x() + cap, bottom));
    }
  }
}

void PlotOverlay::paintReadOut(QPainter& painter) const {
  if (!readOut_) return;
  const QPointF centre = toPosition_(readOut_->value);
  const QColor colour = colours_.series(readOut_->colour);
  painter.setPen(QPen(colours_.axis, 1, Qt::DotLine));
  painter.drawLine(QPointF(centre.x(), area_.top()), QPointF(centre.x(), area_.bottom()));
  painter.setPen(QPen(colours_.background, 1.5));
  painter.setBrush(colour);
  painter.drawEllipse(centre, 5, 5);

  // The box keeps inside the plot: right of and above the point where there is room.
  QRectF box = QFontMetricsF(font_).boundingRect(QRectF(0, 0, 360, 400), Qt::AlignLeft, readOut_->text);
  box.adjust(-8, -5, 8, 5);
  box.moveLeft(centre.x() + 12 + box.width() > area_.right() ? centre.x() - 12 - box.width() : centre.x() + 12);
  // In a narrow plot neither side has room: its left edge is read first.
  box.moveLeft(std::max(box.left(), area_.left() + 2));
  box.moveBottom(std::max(centre.y() - 10, area_.top() + box.height() + 2));
  QColor behind = colours_.background;
  behind.setAlphaF(0.94F);
  painter.setPen(QPen(colour, 1.2));
  painter.setBrush(behind);
  painter.drawRoundedRect(box, 4, 4);
  painter.setPen(colours_.text);
  painter.drawText(box.adjusted(8, 5, -8, -5), Qt::AlignLeft | Qt::AlignVCenter, readOut_->text);
}

}  // namespace btr::ui
