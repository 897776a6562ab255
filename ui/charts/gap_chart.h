#pragma once
#include <QWidget>

#include "core/run/reality/reality_gap.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

class PlotWidget;

/// The reality gap, mean |real − simulated|, by measurement stage: before and after the stage's simulator update
/// (joined by a line, error bar from repeats), of the stage's own individuals before the update, which that simulator
/// had not seen, and of the held-out individuals where there are any.
PlotData gapPlot(const std::vector<GapRecord>& gaps, const std::vector<SimulatorRecord>& simulators, bool standIn,
                 const QString& unit, GapNorm norm = GapNorm::meanAbsolute);

class GapChart : public QWidget {
  Q_OBJECT

 public:
  explicit GapChart(QWidget* parent = nullptr);
  void setUnit(const QString& unit);
  void setStandIn(bool standIn);
  /// What L3 makes small; the chart says so where it is not the mean gap that it shows.
  void setNorm(GapNorm norm);
  /// `simulators` give the version numbers on the axis.
  void setGaps(const std::vector<GapRecord>& gaps, const std::vector<SimulatorRecord>& simulators);
  PlotWidget& plot() { return *plot_; }

 private:
  void redraw();

  PlotWidget* plot_;
  QString unit_;
  bool standIn_ = false;
  GapNorm norm_ = GapNorm::meanAbsolute;
  std::vector<GapRecord> gaps_;
  std::vector<SimulatorRecord> simulators_;
};

}  // namespace btr::ui
