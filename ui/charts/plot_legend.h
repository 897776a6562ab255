#pragma once
#include <QFont>
#include <QGraphicsObject>
#include <set>
#include <vector>

#include "ui/charts/plot_colours.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// Names of what a plot shows, in as many centred rows as they need; shortened in the middle only where they would take
/// more than the height that they are given. A click hides or shows; a hidden
/// name stays, struck out. A band and a series of the same name are one entry.
class PlotLegend final : public QGraphicsObject {
  Q_OBJECT

 public:
  /// Borrows the data and the hidden names of its ChartScene.
  PlotLegend(const PlotData& data, const std::set<QString>& hidden, QGraphicsItem* parent);

  void setColours(const PlotColours& colours);
  void setFont(const QFont& font);
  /// Arranges the entries; returns the height they take, at most `most` or one row.
  double arrange(double width, double most);
  QStringList names() const;
  /// On paper nothing can be clicked: hidden names are left out there. Takes effect with the next arrange().
  void setHiddenListed(bool listed) { hiddenListed_ = listed; }
  /// Of the entry's symbol and name, in this item's coordinates; empty if there is none.
  QRectF placeOf(const QString& name) const;

  QRectF boundingRect() const override { return {0, 0, width_, height_}; }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

 signals:
  void clicked(const QString& name);

 protected:
  void mousePressEvent(QGraphicsSceneMouseEvent* event) override;

 private:
  struct Entry {
    QString name;
    const PlotSeries* series = nullptr;
    const PlotBand* band = nullptr;
    QRectF place;
    QString shown = {};  ///< the name, or what there is room for
  };
  std::vector<Entry> entries() const;
  double place(double width, double widest);
  void paintSymbol(QPainter& painter, const Entry& entry, const QRectF& place) const;

  const PlotData& data_;
  const std::set<QString>& hidden_;
  PlotColours colours_;
  QFont font_;
  bool hiddenListed_ = true;
  double width_ = 0, height_ = 0;
  std::vector<Entry> arranged_;
};

}  // namespace btr::ui
