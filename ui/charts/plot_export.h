#pragma once
#include <QRectF>
#include <QString>
#include <functional>
#include <string>

#include "ui/charts/plot_data.h"

class QPainter;

namespace btr::ui {

/// All numbers of a plot, one a row: series,<x>,<y>,error,lower,upper,note. Markers have their label in `series` and no
/// y.
std::string toCsv(const PlotData& data);

/// A picture that can be painted into any rectangle of the given size (logical pixels).
struct PlotPicture {
  QSizeF size;
  QString title, note;
  std::function<void(QPainter&, const QRectF& target)> paint;
};

/// Writes a plot to `path`; its ending says how: .png (twice the resolution of the screen), .svg, .pdf or .csv.
/// Throws InputError if the ending is another one or the file cannot be written.
void exportPlot(const QString& path, const PlotData& data, const PlotPicture& picture);

/// Filter line of a file dialog for the endings above.
QString exportFilter();

}  // namespace btr::ui
