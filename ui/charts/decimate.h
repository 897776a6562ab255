#pragma once
#include <QPointF>
#include <vector>

namespace btr::ui {

/// Thins a curve (x does not decrease) to what a screen can show: of each of `columns` equal columns between `from` and
/// `to` the first, lowest, highest and last point, in their order, so that no peak is lost. Of the points outside, the
/// nearest on each side stays, so that the line leaves the plot as it should. Curves of at most 2 points a column are
/// returned whole.
std::vector<QPointF> decimate(const std::vector<QPointF>& points, double from, double to, int columns);

}  // namespace btr::ui
