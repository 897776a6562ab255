#include "ui/charts/chart_scene.h"

#include <QAreaSeries>
#include <QCategoryAxis>
#include <QChart>
#include <QGraphicsLayout>
#include <QGraphicsScene>
#include <QGraphicsTextItem>
#include <QLineSeries>
#include <QLogValueAxis>
#include <QScatterSeries>
#include <QValueAxis>
#include <algorithm>
#include <cmath>

#include "ui/charts/decimate.h"
#include "ui/charts/nice_numbers.h"

namespace btr::ui {
namespace {

bool isPoints(PlotSeries::Style style) {
  return style == PlotSeries::Style::points || style == PlotSeries::Style::hollowPoints;
}

/// Objects can be kept if only numbers changed.
bool sameShape(const PlotData& a, const PlotData& b) {
  return a.xLabels == b.xLabels &&
         std::equal(a.series.begin(), a.series.end(), b.series.begin(), b.series.end(),
                    [](auto& s, auto& t) { return s.name == t.name && s.style == t.style && s.colour == t.colour; }) &&
         std::equal(a.bands.begin(), a.bands.end(), b.bands.begin(), b.bands.end(),
                    [](auto& s, auto& t) { return s.name == t.name && s.colour == t.colour; });
}

QList<QPointF> asList(const std::vector<QPointF>& points) { return {points.begin(), points.end()}; }

}  // namespace

ChartScene::ChartScene(QObject* parent) : QObject(parent), chart_(new QChart) {
  chart_->setBackgroundRoundness(0);
  chart_->setMargins({6, 4, 10, 4});
  chart_->layout()->setContentsMargins(0, 0, 0, 0);
  // Qt Charts' own legend shortens names and loses those of hidden series.
  chart_->legend()->hide();
  legend_ = new PlotLegend(data_, hidden_, chart_);
  connect(legend_, &PlotLegend::clicked, this, [this](const QString& name) {
    setShown(name, !isShown(name));
    emit shownChanged();
  });
  connect(chart_, &QChart::geometryChanged, this, &ChartScene::arrangeLegend);
  connect(chart_, &QChart::geometryChanged, this, &ChartScene::updateTitle);
  overlay_ = new PlotOverlay(
      data_, hidden_, [this](QPointF value) { return toPosition(value); }, chart_);
  connect(chart_, &QChart::plotAreaChanged, this, [this](const QRectF& area) {
    overlay_->setArea(area);
    refreshTicks();
    refresh();
  });
  rebuild();
}

void ChartScene::setData(PlotData data) {
  const bool keep = sameShape(data_, data);
  data_ = std::move(data);
  for (const PlotSeries& series : data_.series)
    if (series.hiddenAtFirst && met_.insert(series.name).second) hidden_.insert(series.name);
  if (keep)
    obeyHidden();
  else
    rebuild();
  updateTitle();
  arrangeLegend();
  overlay_->refresh();
}

void ChartScene::rebuild() {
  chart_->removeAllSeries();
  series_.clear();
  bands_.clear();

  // Bands first: curves are drawn over them.
  for (const PlotBand& band : data_.bands) {
    auto* area = new QAreaSeries(new QLineSeries, new QLineSeries);
    area->upperSeries()->setParent(area);
    area->lowerSeries()->setParent(area);
    area->setName(band.name);
    chart_->addSeries(area);
    bands_.push_back(area);
  }
  for (const PlotSeries& wanted : data_.series) {
    QXYSeries* series = nullptr;
    if (isPoints(wanted.style))
      series = new QScatterSeries;
    else
      series = new QLineSeries;
    series->setName(wanted.name);
    chart_->addSeries(series);
    series_.push_back(series);
  }
  rebuildAxes();
  restyle();
}

void ChartScene::rebuildAxes() {
  for (QAbstractAxis* axis : chart_->axes()) {
    chart_->removeAxis(axis);
    delete axis;
  }
  if (data_.xLabels.isEmpty()) {
    auto* axis = new QValueAxis;
    axis->setTickType(QValueAxis::TicksDynamic);
    xAxis_ = axis;
  } else {
    auto* axis = new QCategoryAxis;
    axis->setLabelsPosition(QCategoryAxis::AxisLabelsPositionOnValue);
    // Long names side by side would be cut: their numbers stand for them, and the names beside the chart.
    constexpr qsizetype longest = 20;
    const bool fit = std::ranges::all_of(data_.xLabels, [](const QString& text) { return text.size() <= longest; });
    int count = 0;
    for (auto label = data_.xLabels.begin(); label != data_.xLabels.end(); ++label)
      axis->append(fit ? label.value() : QString::number(++count), label.key());
    xAxis_ = axis;
  }
  if (logarithmic_) {
    auto* axis = new QLogValueAxis;
    axis->setLabelFormat("%g");
    axis->setMinorTickCount(-1);
    yAxis_ = axis;
  } else {
    auto* axis = new QValueAxis;
    axis->setTickType(QValueAxis::TicksDynamic);
    yAxis_ = axis;
  }
  chart_->addAxis(xAxis_, Qt::AlignBottom);
  chart_->addAxis(yAxis_, Qt::AlignLeft);
  for (QAbstractSeries* series : chart_->series()) {
    series->attachAxis(xAxis_);
    series->attachAxis(yAxis_);
  }
}

void ChartScene::setLogarithmic(bool on) {
  if (on == logarithmic_) return;
  logarithmic_ = on;
  rebuildAxes();
  restyle();
  updateTitle();
}

void ChartScene::setRange(const QRectF& range) {
  range_ = range;
  if (logarithmic_) {
    const double top = range.bottom() > 0 ? range.bottom() : 1;
    range_ = QRectF(QPointF(range.left(), range.top() > 0 ? range.top() : top * 1e-3), QPointF(range.right(), top));
  }
  // The interval of one range must never meet the other: 1e-12 of new fitness on an old axis to 1 would be 10¹² labels.
  const auto loosen = [](QAbstractAxis* axis, double span) {
    if (auto* values = qobject_cast<QValueAxis*>(axis); values && axis->type() == QAbstractAxis::AxisTypeValue)
      values->setTickInterval(std::max({span, values->max() - values->min(), values->tickInterval()}));
  };
  changingRange_ = true;
  loosen(xAxis_, range_.width());
  loosen(yAxis_, range_.height());
  xAxis_->setRange(range_.left(), range_.right());
  yAxis_->setRange(range_.top(), range_.bottom());
  changingRange_ = false;
  refreshTicks();
  refresh();
}

void ChartScene::refreshTicks() {
  // A range of more figures moves the plot's edges, which asks for ticks before the other axis has its range.
  if (changingRange_) return;
  const QRectF area = chart_->plotArea();
  if (auto* axis = qobject_cast<QValueAxis*>(xAxis_); axis && axis->type() == QAbstractAxis::AxisTypeValue) {
    const double step = niceStep(range_.width(), std::clamp(static_cast<int>(area.width() / 70), 2, 12), data_.wholeX);
    axis->setTickInterval(step);
    axis->setLabelFormat(tickFormat(step, std::max(std::abs(range_.left()), std::abs(range_.right()))));
  }
  if (auto* axis = qobject_cast<QValueAxis*>(yAxis_)) {
    const int most = std::clamp(static_cast<int>(area.height() / 24), 3, 10);
    double step = niceStep(range_.height(), most);
    // A single tick gives no scale.
    for (int more = most + 1; ticksWithin(range_.top(), range_.bottom(), step) < 2 && more < 4 * most; ++more)
      step = niceStep(range_.height(), more);
    axis->setTickInterval(step);
    axis->setLabelFormat(tickFormat(step, std::max(std::abs(range_.top()), std::abs(range_.bottom()))));
  }
}

void ChartScene::tidyLabels() {
  for (QGraphicsItem* item : chart_->scene() ? chart_->scene()->items() : QList<QGraphicsItem*>())
    if (auto* label = qgraphicsitem_cast<QGraphicsTextItem*>(item))
      if (const QString text = label->toPlainText(); isNegativeZero(text)) label->setHtml(text.mid(1));
}

void ChartScene::refresh() {
  const int columns = std::max(100, static_cast<int>(chart_->plotArea().width()));
  const auto thinned = [&](std::vector<QPointF> points, bool line) {
    std::erase_if(points, [&](const QPointF& point) { return !allowed(point.y()); });
    return asList(line ? decimate(points, range_.left(), range_.right(), columns) : points);
  };
  for (std::size_t i = 0; i < series_.size(); ++i) {
    std::vector<QPointF> points = data_.series[i].points;
    for (QPointF& point : points) point.rx() += data_.series[i].shift;
    series_[i]->replace(thinned(std::move(points), !isPoints(data_.series[i].style)));
  }
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    const PlotBand& band = data_.bands[i];
    std::vector<QPointF> lower, upper;
    for (std::size_t k = 0; k < band.x.size(); ++k) {
      // The band ends at the lowest visible number where a logarithmic axis cannot show its lower edge.
      if (!allowed(band.upper[k])) continue;
      lower.emplace_back(band.x[k], allowed(band.lower[k]) ? atLeast(band.lower[k]) : range_.top());
      upper.emplace_back(band.x[k], band.upper[k]);
    }
    bands_[i]->lowerSeries()->replace(thinned(lower, true));
    bands_[i]->upperSeries()->replace(thinned(upper, true));
  }
  overlay_->refresh();
}

QRectF ChartScene::fullRange() const {
  double left = INFINITY, right = -INFINITY, low = INFINITY, high = -INFINITY;
  const auto include = [&](double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y) || !allowed(y)) return;
    left = std::min(left, x), right = std::max(right, x);
    low = std::min(low, y), high = std::max(high, y);
  };
  for (const PlotSeries& series : data_.series) {
    if (!isShown(series.name)) continue;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const QPointF point = series.drawnAt(i);
      const double error = i < series.errors.size() ? series.errors[i] : 0;
      include(point.x(), atLeast(point.y() - error));
      include(point.x(), point.y() + error);
    }
  }
  for (const PlotBand& band : data_.bands) {
    if (!isShown(band.name)) continue;
    for (std::size_t i = 0; i < band.x.size(); ++i) {
      include(band.x[i], atLeast(band.lower[i]));
      include(band.x[i], band.upper[i]);
    }
  }
  if (!(left <= right)) left = 0, right = 1, low = logarithmic_ ? 0.1 : 0, high = 1;
  // Marks at the edge are drawn whole.
  const bool marks = std::ranges::any_of(data_.series, [](const PlotSeries& s) {
    return !s.points.empty() && (isPoints(s.style) || s.style == PlotSeries::Style::lineWithPoints);
  });
  if (marks && data_.xLabels.isEmpty() && !data_.xTo) right += 0.015 * (right - left);
  if (data_.xFrom) left = std::min(left, *data_.xFrom);
  if (data_.xTo) right = std::max(right, *data_.xTo);
  if (left == right) left -= 1, right += 1;
  if (logarithmic_) return {QPointF(left, low / 1.3), QPointF(right, high * 1.3)};
  if (data_.yFromZero) low = std::min(low, 0.0), high = std::max(high, 0.0);
  if (low == high) {
    const double room = std::max(0.5, std::abs(low) * 0.1);
    low = data_.yFromZero && low == 0 ? 0 : low - room;
    high += room;
  }
  const double margin = (high - low) * 0.04;
  const double step = niceStep(high - low, 8);
  const bool touchesZero = data_.yFromZero && low == 0;
  const AxisRange y = niceRange(touchesZero ? 0 : low - margin, high + margin, step);
  return {QPointF(left, y.from), QPointF(right, y.to)};
}

void ChartScene::setShown(const QString& name, bool shown) {
  if (shown)
    hidden_.erase(name);
  else
    hidden_.insert(name);
  obeyHidden();
  overlay_->refresh();
}

std::vector<QPointF> ChartScene::drawnPoints(const QString& name) const {
  for (std::size_t i = 0; i < series_.size(); ++i)
    if (data_.series[i].name == name) {
      const QList<QPointF> points = series_[i]->points();
      return {points.begin(), points.end()};
    }
  return {};
}

QPointF ChartScene::toPosition(const QPointF& value) const {
  const QRectF area = chart_->plotArea();
  const double x = (value.x() - range_.left()) / range_.width();
  const double y = logarithmic_ ? std::log(value.y() / range_.top()) / std::log(range_.bottom() / range_.top())
                                : (value.y() - range_.top()) / range_.height();
  return {area.left() + x * area.width(), area.bottom() - y * area.height()};
}

QPointF ChartScene::toValue(const QPointF& position) const {
  const QRectF area = chart_->plotArea();
  const double x = (position.x() - area.left()) / area.width();
  const double y = (area.bottom() - position.y()) / area.height();
  return {range_.left() + x * range_.width(), logarithmic_ ? range_.top() * std::pow(range_.bottom() / range_.top(), y)
                                                           : range_.top() + y * range_.height()};
}

}  // namespace btr::ui
