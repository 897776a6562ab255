#pragma once
#include <QWidget>
#include <optional>

#include "core/run/grid/grid_table.h"

namespace btr::ui {

/// A grid as a cube: cells coloured by fitness, edges as thick as the solutions are alike, failed and replaced cells
/// marked. All distances one behind the other, or one slice. A click chooses a cell, a double click (or Enter) asks for
/// its replay; arrow keys walk.
class CubeView : public QWidget {
  Q_OBJECT
 public:
  explicit CubeView(QWidget* parent = nullptr);

  void setSummary(const GridSummary& summary);
  /// Index of the distance; −1: all.
  void setSlice(int index);
  int slice() const { return slice_; }
  int current() const { return current_; }  ///< cell, 0: none
  void choose(int cell);
  QPointF centreOf(int cell) const;
  double radius() const;
  QString describe(int cell) const;

  QSize sizeHint() const override { return {560, 460}; }
  QSize minimumSizeHint() const override { return {260, 220}; }

 signals:
  void chosen(int cell);
  void replayRequested(int cell);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  std::array<std::size_t, 3> indexOf(int cell) const;
  int numberOf(const std::array<std::size_t, 3>& index) const;
  const GridRow* row(int cell) const;
  bool shown(int cell) const;
  int cellAt(const QPointF& place) const;
  void paintEdges(QPainter& painter) const;
  void paintCell(QPainter& painter, const GridRow& row) const;
  void paintAxes(QPainter& painter) const;
  void paintLegend(QPainter& painter) const;

  GridSummary summary_;
  double highest_ = 1;  ///< fitness at the end of the colours
  int slice_ = -1, current_ = 0;
};

}  // namespace btr::ui
