// How a ChartScene looks: colours, pens, fonts, title and legend.
#include <QAreaSeries>
#include <QChart>
#include <QFontMetricsF>
#include <QLineSeries>
#include <QScatterSeries>
#include <algorithm>

#include "ui/charts/chart_scene.h"

namespace btr::ui {

void ChartScene::setColours(const PlotColours& colours) {
  colours_ = colours;
  overlay_->setColours(colours);
  legend_->setColours(colours);
  restyle();
  updateTitle();
}

void ChartScene::setForPrint(bool print) {
  overlay_->setReadOut({});
  legend_->setHiddenListed(!print);
  isForPrint_ = print;
  arrangeLegend();
}

void ChartScene::setFont(const QFont& font) {
  font_ = font;
  overlay_->setFont(font);
  legend_->setFont(font);
  restyle();
  updateTitle();
}

void ChartScene::restyle() {
  chart_->setBackgroundBrush(colours_.background);
  chart_->setBackgroundPen(Qt::NoPen);
  for (QAbstractAxis* axis : chart_->axes()) {
    axis->setLabelsColor(colours_.faintText);
    axis->setLabelsFont(font_);
    axis->setTitleFont(font_);
    axis->setTitleBrush(colours_.text);
    axis->setGridLinePen(QPen(colours_.grid, 1));
    axis->setMinorGridLineVisible(false);
    axis->setLinePen(QPen(colours_.axis, 1));
  }
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    QColor fill = colours_.series(data_.bands[i].colour);
    fill.setAlphaF(colours_.dark ? 0.28F : 0.2F);
    bands_[i]->setBrush(fill);
    bands_[i]->setPen(Qt::NoPen);
  }
  for (std::size_t i = 0; i < series_.size(); ++i) {
    using Style = PlotSeries::Style;
    const QColor colour = colours_.series(data_.series[i].colour);
    const Style style = data_.series[i].style;
    if (auto* points = qobject_cast<QScatterSeries*>(series_[i])) {
      points->setMarkerSize(9);
      points->setBrush(style == Style::hollowPoints ? colours_.background : colour);
      points->setPen(style == Style::hollowPoints ? QPen(colour, 2) : QPen(colours_.background, 1));
      continue;
    }
    const double width = style == Style::line || style == Style::lineWithPoints ? 2.2 : 1.3;
    QPen pen(colour, width, style == Style::dotted ? Qt::DotLine : Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
    series_[i]->setPen(pen);
    series_[i]->setPointsVisible(style == Style::lineWithPoints);
    if (style == Style::lineWithPoints) series_[i]->setMarkerSize(7);
  }
  obeyHidden();
  arrangeLegend();
}

void ChartScene::obeyHidden() {
  for (QAbstractSeries* series : chart_->series()) series->setVisible(isShown(series->name()));
  legend_->update();
}

void ChartScene::arrangeLegend() {
  constexpr double side = 10, gap = 4;
  const QSizeF size = chart_->size();
  // On paper nothing is shortened; on the screen the plot itself keeps most of the room.
  const double most = isForPrint_ ? size.height() : 0.3 * size.height();
  const double height = legend_->arrange(std::max(50.0, size.width() - 2 * side), most);
  legend_->setPos(side, size.height() - height - gap);
  chart_->setMargins({6, 4, 12, static_cast<int>(height > 0 ? height + 2 * gap : gap)});
}

void ChartScene::updateTitle() {
  QString title = "<b>" + data_.title.toHtmlEscaped() + "</b>";
  QStringList notes;
  if (!data_.note.isEmpty()) notes << data_.note;
  if (logarithmic_) {
    long left = 0;
    for (const PlotSeries& series : data_.series)
      left += std::count_if(series.points.begin(), series.points.end(), [](auto& point) { return !(point.y() > 0); });
    if (left > 0)
      notes << tr("%n value(s) at or below 0 cannot be shown on a logarithmic axis", nullptr, static_cast<int>(left));
  }
  QFont font = font_;
  if (font.pointSizeF() > 0) font.setPointSizeF(font.pointSizeF() * 1.08);
  if (!notes.isEmpty()) {
    // Beside the title where both leave the corners free for the menu, else below it.
    constexpr double corner = 36;
    QFont bold = font;
    bold.setBold(true);
    const QString note = notes.join(" · ");
    const double both =
        QFontMetricsF(bold).horizontalAdvance(data_.title) + QFontMetricsF(font).horizontalAdvance("   " + note);
    title += QString("%1<span style=\"color:%2\">%3</span>")
                 .arg(both > chart_->size().width() - 2 * corner ? "<br>" : " &nbsp;", colours_.note.name(),
                      note.toHtmlEscaped());
  }
  chart_->setTitle(data_.title.isEmpty() && notes.isEmpty() ? QString() : title);
  chart_->setTitleBrush(colours_.text);
  chart_->setTitleFont(font);
  xAxis_->setTitleText(data_.xTitle);
  yAxis_->setTitleText(data_.yTitle);
}

}  // namespace btr::ui
