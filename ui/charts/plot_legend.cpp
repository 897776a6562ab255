#include "ui/charts/plot_legend.h"

#include <QCursor>
#include <QFontMetricsF>
#include <QGraphicsSceneMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace btr::ui {
namespace {
constexpr double symbolWidth = 18, symbolGap = 6, entryGap = 18;
}

PlotLegend::PlotLegend(const PlotData& data, const std::set<QString>& hidden, QGraphicsItem* parent)
    : QGraphicsObject(parent), data_(data), hidden_(hidden) {
  setCursor(Qt::PointingHandCursor);
  setToolTip(tr("Click to hide or show"));
}

void PlotLegend::setColours(const PlotColours& colours) {
  colours_ = colours;
  update();
}

void PlotLegend::setFont(const QFont& font) { font_ = font; }

std::vector<PlotLegend::Entry> PlotLegend::entries() const {
  std::vector<Entry> all;
  for (const PlotSeries& series : data_.series)
    if (!series.name.isEmpty() && std::ranges::find(all, series.name, &Entry::name) == all.end())
      all.push_back({series.name, &series, nullptr, {}});
  for (const PlotBand& band : data_.bands) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const Entry& entry) { return entry.name == band.name; });
    if (same != all.end())
      same->band = &band;
    else if (!band.name.isEmpty())
      all.push_back({band.name, nullptr, &band, {}});
  }
  if (!hiddenListed_) std::erase_if(all, [this](const Entry& entry) { return hidden_.contains(entry.name); });
  return all;
}

QRectF PlotLegend::placeOf(const QString& name) const {
  const auto found = std::find_if(arranged_.begin(), arranged_.end(), [&](const Entry& e) { return e.name == name; });
  return found == arranged_.end() ? QRectF() : found->place;
}

QStringList PlotLegend::names() const {
  QStringList names;
  for (const Entry& entry : entries()) names << entry.name;
  return names;
}

double PlotLegend::arrange(double width, double most) {
  prepareGeometryChange();
  const double rowHeight = QFontMetricsF(font_).height() + 5;
  arranged_ = entries();
  width_ = width;
  height_ = place(width, width);
  // Too high for its plot: in columns of equal width, as many as it takes.
  const auto rows = std::max(1.0, std::floor(most / rowHeight));
  if (height_ > rows * rowHeight) {
    const double columns = std::ceil(static_cast<double>(arranged_.size()) / rows);
    height_ = place(width, std::max(width / columns - entryGap, 4 * symbolWidth));
  }
  update();
  return height_;
}

double PlotLegend::place(double width, double widest) {
  const QFontMetricsF metrics(font_);
  const double rowHeight = metrics.height() + 5;
  const double room = widest - symbolWidth - symbolGap;
  for (Entry& entry : arranged_) entry.shown = metrics.elidedText(entry.name, Qt::ElideMiddle, room);
  double y = 0;
  for (auto first = arranged_.begin(); first != arranged_.end(); y += rowHeight) {
    // Fill a row, then centre it.
    double x = 0;
    auto last = first;
    for (; last != arranged_.end(); ++last) {
      const double needed = symbolWidth + symbolGap + metrics.horizontalAdvance(last->shown);
      if (last != first && x + needed > width) break;
      last->place = QRectF(x, y, needed, rowHeight);
      x += needed + entryGap;
    }
    const double shift = std::max(0.0, (width - (x - entryGap)) / 2);
    for (; first != last; ++first) first->place.translate(shift, 0);
  }
  return y;
}

void PlotLegend::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  painter->setRenderHint(QPainter::Antialiasing);
  for (const Entry& entry : arranged_) {
    const bool shown = !hidden_.contains(entry.name);
    painter->setOpacity(shown ? 1 : 0.45);
    paintSymbol(*painter, entry, QRectF(entry.place.topLeft(), QSizeF(symbolWidth, entry.place.height())));
    QFont font = font_;
    font.setStrikeOut(!shown);
    painter->setFont(font);
    painter->setPen(colours_.text);
    painter->drawText(entry.place.adjusted(symbolWidth + symbolGap, 0, 2, 0), Qt::AlignLeft | Qt::AlignVCenter,
                      entry.shown);
  }
  painter->setOpacity(1);
}

void PlotLegend::paintSymbol(QPainter& painter, const Entry& entry, const QRectF& place) const {
  const double y = place.center().y();
  if (entry.band) {
    QColor fill = colours_.series(entry.band->colour);
    fill.setAlphaF(0.3F);
    painter.fillRect(QRectF(place.left(), y - 5, symbolWidth, 10), fill);
  }
  if (!entry.series) return;
  using Style = PlotSeries::Style;
  const QColor colour = colours_.series(entry.series->colour);
  const Style style = entry.series->style;
  if (style == Style::points || style == Style::hollowPoints) {
    painter.setPen(QPen(colour, 2));
    painter.setBrush(style == Style::points ? colour : colours_.background);
    painter.drawEllipse(QPointF(place.center().x(), y), 3.5, 3.5);
    return;
  }
  const bool thick = style == Style::line || style == Style::lineWithPoints;
  painter.setPen(QPen(colour, thick ? 2.4 : 1.3, style == Style::dotted ? Qt::DotLine : Qt::SolidLine));
  painter.drawLine(QPointF(place.left(), y), QPointF(place.left() + symbolWidth, y));
  painter.setBrush(colour);
  if (style == Style::lineWithPoints) painter.drawEllipse(QPointF(place.center().x(), y), 2.5, 2.5);
}

void PlotLegend::mousePressEvent(QGraphicsSceneMouseEvent* event) {
  for (const Entry& entry : arranged_)
    if (entry.place.contains(event->pos())) {
      emit clicked(entry.name);
      return;
    }
  event->ignore();
}

}  // namespace btr::ui
