#pragma once
#include <QFont>
#include <QObject>
#include <QRectF>
#include <set>

#include "ui/charts/plot_colours.h"
#include "ui/charts/plot_data.h"
#include "ui/charts/plot_legend.h"
#include "ui/charts/plot_overlay.h"

class QAbstractAxis;
class QAbstractSeries;
class QAreaSeries;
class QChart;
class QXYSeries;

namespace btr::ui {

/// The chart library's objects behind a PlotWidget: turns a PlotData into series, axes and legend, and keeps them
/// thinned to the visible range. Series are never appended to; each refresh replaces their points, which is fast.
class ChartScene : public QObject {
  Q_OBJECT

 public:
  /// Owns the chart until a view takes it into its scene.
  explicit ChartScene(QObject* parent);

  QChart* chart() const { return chart_; }
  const PlotData& data() const { return data_; }
  void setData(PlotData data);

  void setColours(const PlotColours& colours);
  const PlotColours& colours() const { return colours_; }
  /// Leaves out what only a screen needs: read-out and hidden names.
  void setForPrint(bool print);
  void setFont(const QFont& font);

  /// Visible values (top is the lowest y).
  void setRange(const QRectF& range);
  QRectF range() const { return range_; }
  /// What shows all visible series and bands, rounded outwards to ticks.
  QRectF fullRange() const;

  void setLogarithmic(bool on);
  bool isLogarithmic() const { return logarithmic_; }

  bool isShown(const QString& name) const { return !hidden_.contains(name); }
  void setShown(const QString& name, bool shown);
  QStringList legendNames() const { return legend_->names(); }

  std::vector<QPointF> drawnPoints(const QString& name) const;
  void setReadOut(std::optional<PlotOverlay::ReadOut> readOut) { overlay_->setReadOut(std::move(readOut)); }
  QPointF toPosition(const QPointF& value) const;  ///< in the chart's coordinates
  /// The library writes "−0.0" where its sum of steps misses 0 by a rounding error; to be called before painting.
  void tidyLabels();
  QPointF toValue(const QPointF& position) const;

 signals:
  /// A click in the legend changed what is shown.
  void shownChanged();

 private:
  void rebuild();
  void rebuildAxes();
  void refresh();
  void refreshTicks();
  void restyle();
  void obeyHidden();
  void arrangeLegend();
  void updateTitle();
  double atLeast(double y) const { return data_.neverNegative && y < 0 ? 0 : y; }
  bool allowed(double y) const { return !logarithmic_ || y > 0; }

  QChart* chart_ = nullptr;
  PlotOverlay* overlay_ = nullptr;
  PlotLegend* legend_ = nullptr;
  PlotData data_;
  PlotColours colours_;
  QFont font_;
  QRectF range_{0, 0, 1, 1};
  bool logarithmic_ = false, changingRange_ = false, isForPrint_ = false;
  std::set<QString> hidden_, met_;   ///< met: names whose hiddenAtFirst has been obeyed
  std::vector<QXYSeries*> series_;   ///< as data_.series
  std::vector<QAreaSeries*> bands_;  ///< as data_.bands
  QAbstractAxis* xAxis_ = nullptr;
  QAbstractAxis* yAxis_ = nullptr;
};

}  // namespace btr::ui
