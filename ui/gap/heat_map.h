#pragma once
#include <QAbstractScrollArea>
#include <memory>
#include <optional>

#include "core/gap/report/report_figures.h"
#include "core/gap/search/gap_report.h"

namespace btr::ui {

/// Standardised error by channel and time: a row a trial and channel, a cell a stretch of time. A click, or the arrow
/// keys, choose a cell; the tool tip tells its numbers.
class HeatMap : public QAbstractScrollArea {
  Q_OBJECT
 public:
  static constexpr std::size_t bins = 80;
  explicit HeatMap(QWidget* parent = nullptr);

  void setReport(std::shared_ptr<const GapReport> report);
  void setSimulated(Simulated which);

  struct Cell {
    std::size_t row = 0, bin = 0;
  };
  int rows() const { return int(rows_.size()); }
  const HeatRow& row(std::size_t i) const { return rows_[i]; }
  std::optional<Cell> current() const { return current_; }
  void choose(Cell cell);
  /// The worst cell of all, chosen; nothing if there is none.
  void chooseWorst();
  QRect rectOf(Cell cell) const;  ///< in the viewport
  QString describe(Cell cell) const;
  std::vector<QRect> scalePlaces() const;  ///< of the colours' legend, each with its number, in the viewport

  QSize sizeHint() const override { return {700, 220}; }
  QSize minimumSizeHint() const override { return {320, 110}; }

 signals:
  /// Another cell was chosen; the time is the middle of the cell.
  void chosen(std::size_t trial, std::size_t series, double time_s);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool viewportEvent(QEvent* event) override;

 private:
  void refill();
  void arrange();
  void reveal();
  int rowHeight() const;
  int labelWidth() const;
  std::optional<Cell> cellAt(const QPoint& place) const;
  void paintScale(QPainter& painter) const;

  std::shared_ptr<const GapReport> report_;
  Simulated which_ = Simulated::asGiven;
  std::vector<HeatRow> rows_;
  std::optional<Cell> current_;
};

}  // namespace btr::ui
