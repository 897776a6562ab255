#pragma once
#include <QRectF>
#include <QWidget>
#include <memory>

#include "ui/charts/plot_data.h"

namespace btr::ui {

/// A plot of named curves, points, bands and markers. The only part of the program that knows the chart library behind
/// it. Give it a PlotData; it thins curves to the screen, chooses ticks and follows the palette (light or dark). Mouse:
/// drag to zoom into a rectangle, wheel to zoom at the pointer, middle button to move, double click for everything,
/// hover for exact numbers, click a name in the legend to hide or show it. Keys: Home, +, −, arrows. Menu: copy,
/// export, log axis.
class PlotWidget : public QWidget {
  Q_OBJECT

 public:
  explicit PlotWidget(QWidget* parent = nullptr);
  ~PlotWidget() override;

  /// Replaces what is shown; zoom and hidden names stay. Drawn when the event loop turns and the widget is seen, so
  /// that of data that come faster only the last are drawn; whoever asks sees them at once.
  void setData(PlotData data);
  const PlotData& data() const;
  /// What is drawn of a series after thinning to the present zoom; empty if there is no such series.
  std::vector<QPointF> drawnPoints(const QString& series) const;

  bool isSeriesShown(const QString& name) const;
  /// Also for bands. The name stays in the legend, greyed.
  void setSeriesShown(const QString& name, bool shown);
  QStringList legendNames() const;

  /// Visible values: left() to right(), top() is the lowest y, bottom() the highest.
  QRectF visibleRange() const;
  void zoomTo(const QRectF& values);
  void resetZoom();
  bool isZoomed() const;

  /// Values at or below zero cannot be shown on a logarithmic axis: they are left out, and a line says how many.
  void setLogarithmic(bool on);
  bool isLogarithmic() const;

  /// Exact numbers of the point nearest to a place in this widget, "" if none is near.
  QString readOutAt(const QPoint& place) const;
  /// Where a value is drawn in this widget.
  QPoint placeOf(const QPointF& value) const;

  /// Always dark on white. The ending of `path` says how: .png .svg .pdf .csv. Throws InputError.
  void exportTo(const QString& path);
  void copyToClipboard();
  /// Asks for a file and exports; errors are shown.
  void exportWithDialog();

  QSize sizeHint() const override { return {640, 380}; }
  QSize minimumSizeHint() const override { return {260, 180}; }

 signals:
  /// By the user or by a call: zoomed, moved, or everything shown again.
  void rangeChanged();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  struct Impl;
  Impl& settled() const;  ///< with what was given last
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::ui
