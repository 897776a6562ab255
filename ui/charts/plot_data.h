#pragma once
#include <QMap>
#include <QPointF>
#include <QString>
#include <optional>
#include <vector>

namespace btr::ui {

/// Everything that one plot shows, as a value: a page builds it from records, PlotWidget draws and exports it.
/// Numbers are the records' own; nothing is rounded or thinned out here.

struct PlotSeries {
  enum class Style { line, thinLine, dotted, points, hollowPoints, lineWithPoints };
  QString name;    ///< in the legend; unique within a plot but for what goes on behind a gap; "" stays out of it
  int colour = 0;  ///< index into the theme's series colours
  Style style = Style::line;
  std::vector<QPointF> points;  ///< x does not decrease where the style draws a line
  std::vector<double> errors;   ///< half lengths of error bars, one a point, or empty; 0 draws none
  bool hiddenAtFirst = false;   ///< until the user clicks its name in the legend
  double shift = 0;             ///< drawn so far to the right of its x, where marks would cover each other

  QPointF drawnAt(std::size_t i) const { return points[i] + QPointF(shift, 0); }
};

/// An area between two curves, for example a 95 % interval.
struct PlotBand {
  QString name;
  int colour = 0;
  std::vector<double> x, lower, upper;
};

/// A vertical line with a label.
struct PlotMarker {
  double x = 0;
  QString label;
};

/// A line between two places as drawn (with their series' shift), shown and hidden with the series it belongs to.
struct PlotSegment {
  QPointF from, to;
  QString series;
};

struct PlotData {
  QString title;
  QString note;              ///< stands out beside the title and in every export, e.g. "stand-in reality"
  QString xTitle, yTitle;    ///< with units, for people
  QString xColumn, yColumn;  ///< the same for CSV files, a unit at the end: "generation", "fitness_m"
  bool wholeX = false;       ///< ticks on whole numbers only
  bool yFromZero = false;
  bool neverNegative = false;        ///< a distance, a gap: intervals are drawn down to 0 only
  std::optional<double> xFrom, xTo;  ///< the axis reaches at least so far
  QMap<double, QString> xLabels;     ///< not empty: words on the x axis; long ones are counted there, from 1
  QString empty = "No data yet";     ///< shown while there is no point
  std::vector<PlotSeries> series;
  std::vector<PlotBand> bands;
  std::vector<PlotMarker> markers;
  std::vector<PlotSegment> segments;
};

/// "fitness" and "cm/s" give "fitness_cm_s": a column that carries a number ends in its unit.
QString columnName(const QString& quantity, const QString& unit);
/// "fitness" and "cm/s" give "fitness (cm/s)".
QString axisTitle(const QString& quantity, const QString& unit);
/// Shortest text that reads back as the same number.
QString exactText(double value);

}  // namespace btr::ui
