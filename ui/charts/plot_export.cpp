#include "ui/charts/plot_export.h"

#include <QBuffer>
#include <QFileInfo>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QSvgGenerator>
#include <algorithm>
#include <utility>

#include "core/spec/error.h"

namespace btr::ui {
namespace {

QString quoted(QString text) {
  if (!text.contains(',') && !text.contains('"') && !text.contains('\n')) return text;
  return '"' + text.replace('"', "\"\"") + '"';
}

bool isOfSeries(const PlotData& data, const PlotBand& band) {
  return std::ranges::any_of(data.series, [&](const PlotSeries& series) { return series.name == band.name; });
}

/// The interval of a mean stands in the mean's own row: that of the band of the same name at the same place.
std::pair<QString, QString> intervalAt(const PlotData& data, const PlotSeries& series, std::size_t point) {
  for (const PlotBand& band : data.bands)
    for (std::size_t k = 0; k < band.x.size() && band.name == series.name; ++k)
      if (band.x[k] == series.drawnAt(point).x()) return {exactText(band.lower[k]), exactText(band.upper[k])};
  return {};
}

QByteArray png(const PlotPicture& picture) {
  QImage image((picture.size * 2).toSize(), QImage::Format_ARGB32_Premultiplied);
  image.setDevicePixelRatio(2);
  image.fill(Qt::white);
  QPainter painter(&image);
  picture.paint(painter, QRectF({0, 0}, picture.size));
  painter.end();
  image.setText("Title", picture.title);
  image.setText("Comment", picture.note);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  image.save(&buffer, "PNG");
  return bytes;
}

QByteArray svg(const PlotPicture& picture) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(picture.size.toSize());
  generator.setViewBox(QRectF({0, 0}, picture.size));
  generator.setTitle(picture.title);
  generator.setDescription(picture.note);
  QPainter painter(&generator);
  picture.paint(painter, QRectF({0, 0}, picture.size));
  painter.end();
  return bytes;
}

QByteArray pdf(const PlotPicture& picture) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setTitle(picture.title);
  writer.setPageSize(QPageSize(picture.size * 0.75, QPageSize::Point, {}, QPageSize::ExactMatch));
  writer.setPageMargins({});
  // 96 units an inch: fonts keep the size they have on the screen.
  writer.setResolution(96);
  QPainter painter(&writer);
  picture.paint(painter, QRectF(0, 0, writer.width(), writer.height()));
  painter.end();
  return bytes;
}

}  // namespace

std::string toCsv(const PlotData& data) {
  const QString note = quoted(data.note);
  QString text = QString("series,%1,%2,error,lower,upper,note\n").arg(quoted(data.xColumn), quoted(data.yColumn));
  for (const PlotSeries& series : data.series)
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const QString error = i < series.errors.size() ? exactText(series.errors[i]) : QString();
      const auto [lower, upper] = intervalAt(data, series, i);
      text += QStringList{quoted(series.name),
                          exactText(series.points[i].x()),
                          exactText(series.points[i].y()),
                          error,
                          lower,
                          upper,
                          note}
                  .join(',') +
              '\n';
    }
  for (const PlotBand& band : data.bands)
    for (std::size_t i = 0; i < band.x.size() && !isOfSeries(data, band); ++i)
      text += QStringList{quoted(band.name),        exactText(band.x[i]),     "",  "",
                          exactText(band.lower[i]), exactText(band.upper[i]), note}
                  .join(',') +
              '\n';
  for (const PlotMarker& marker : data.markers)
    text += QStringList{quoted(marker.label), exactText(marker.x), "", "", "", "", note}.join(',') + '\n';
  return text.toStdString();
}

void exportPlot(const QString& path, const PlotData& data, const PlotPicture& picture) {
  const QString ending = QFileInfo(path).suffix().toLower();
  QByteArray bytes;
  if (ending == "csv")
    bytes = QByteArray::fromStdString(toCsv(data));
  else if (ending == "png")
    bytes = png(picture);
  else if (ending == "svg")
    bytes = svg(picture);
  else if (ending == "pdf")
    bytes = pdf(picture);
  else
    throw InputError(path.toStdString(), "the ending \"" + ending.toStdString() + "\"", ".png, .svg, .pdf or .csv");

  // All of it or nothing: an older file stays as it was if the disk is full.
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
    throw InputError(path.toStdString() + ": cannot be written (" + file.errorString().toStdString() +
                     "); choose a folder that you may write to");
}

QString exportFilter() { return "Picture (*.png);;Vector graphics (*.svg);;PDF document (*.pdf);;Numbers (*.csv)"; }

}  // namespace btr::ui
