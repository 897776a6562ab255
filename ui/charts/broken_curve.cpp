#include "ui/charts/broken_curve.h"

#include <algorithm>

namespace btr::ui {
namespace {

constexpr double pause = 2.5;  // of the usual distance of points: a single one that is missing is none

double longestWithin(const std::vector<QPointF>& points) {
  std::vector<double> apart;
  for (std::size_t i = 1; i < points.size(); ++i) apart.push_back(points[i].x() - points[i - 1].x());
  if (apart.empty()) return 0;
  const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  std::nth_element(apart.begin(), middle, apart.end());
  return pause * *middle;
}

}  // namespace

void addBroken(PlotData& plot, const PlotSeries& whole) {
  const double longest = longestWithin(whole.points);
  PlotSeries stretch = whole;
  stretch.points.clear();
  for (const QPointF& point : whole.points) {
    if (!stretch.points.empty() && point.x() - stretch.points.back().x() > longest) {
      plot.series.push_back(stretch);
      stretch.points.clear();
    }
    stretch.points.push_back(point);
  }
  plot.series.push_back(std::move(stretch));
}

}  // namespace btr::ui
