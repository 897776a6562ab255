#pragma once
#include <QFont>
#include <QGraphicsItem>
#include <functional>
#include <optional>
#include <set>

#include "ui/charts/plot_colours.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// What a chart library does not draw: vertical markers with labels, error bars, joining lines and the read-out under
/// the mouse. One item over the plot area; it borrows the data of its PlotWidget.
class PlotOverlay final : public QGraphicsItem {
 public:
  /// The point under the mouse.
  struct ReadOut {
    QPointF value;
    QString text;
    int colour = 0;
  };

  /// `toPosition` maps values to the parent's coordinates.
  PlotOverlay(const PlotData& data, const std::set<QString>& hidden, std::function<QPointF(QPointF)> toPosition,
              QGraphicsItem* parent);

  void setArea(const QRectF& plotArea);
  void setColours(const PlotColours& colours);
  void setFont(const QFont& font);
  void setReadOut(std::optional<ReadOut> readOut);
  void refresh() { update(); }

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

 private:
  void paintMarkers(QPainter& painter) const;
  void paintSegments(QPainter& painter) const;
  void paintErrorBars(QPainter& painter) const;
  void paintReadOut(QPainter& painter) const;
  bool isShown(const QString& series) const { return !hidden_.contains(series); }

  const PlotData& data_;
  const std::set<QString>& hidden_;
  std::function<QPointF(QPointF)> toPosition_;
  QRectF area_;
  PlotColours colours_;
  QFont font_;
  std::optional<ReadOut> readOut_;
};

}  // namespace btr::ui
