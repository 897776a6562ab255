#pragma once
#include <QWidget>
#include <optional>

#include "core/run/grid/grid_losses.h"

namespace btr::ui {

/// Interpolated kicks over the ball's bearing (to the left) and the target's direction (upwards) at one distance: what
/// they lose, or their fitness, or one of the figures that the fitness tells. A click chooses a point.
class KickMap : public QWidget {
  Q_OBJECT
 public:
  explicit KickMap(QWidget* parent = nullptr);

  void setMap(std::optional<GridMap> map);
  const std::optional<GridMap>& map() const { return map_; }
  /// "" paints what is lost, "fitness" or the name of a figure paints that.
  void setShown(const QString& what);
  /// What can be shown: names of figures.
  QStringList figures() const;
  /// The cells' places are marked.
  void setAxes(const std::vector<double>& bearings, const std::vector<double>& directions);
  /// The point that the preview plays.
  void setPoint(double bearing_rad, double direction_rad);
  QRectF frame() const;  ///< of the painted area
  QString describe(std::size_t point) const;
  /// Share of the points that lose that.
  double shareOf(GridLoss loss) const;

  QSize sizeHint() const override { return {420, 420}; }
  QSize minimumSizeHint() const override { return {240, 240}; }

 signals:
  void chosen(double bearing_rad, double direction_rad);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  std::optional<std::size_t> pointAt(const QPointF& place) const;
  QPointF placeOf(double bearing, double direction) const;
  QRectF boxOf(std::size_t point) const;
  std::optional<double> valueOf(const GridPoint& point) const;
  void paintLegend(QPainter& painter) const;

  std::optional<GridMap> map_;
  std::vector<GridLoss> losses_;
  QString shown_;
  double lowest_ = 0, highest_ = 1;
  std::vector<double> bearings_, directions_;
  double bearing_ = 0, direction_ = 0;
};

}  // namespace btr::ui
