#include "ui/live/panels/thing_palette.h"

#include <QEvent>
#include <QMimeData>
#include <QPainter>

#include "ui/live/drawn/live_view.h"

namespace btr::ui {
namespace {

/// A small drawing of its shape.
QIcon pictureOf(const ThingToAdd& thing, const QPalette& palette) {
  QPixmap picture(32, 32);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(palette.text().color(), 2));
  if (std::holds_alternative<BallSpec>(thing.what)) {
    painter.setBrush(QColor(240, 130, 30));
    painter.drawEllipse(QRectF(5, 5, 22, 22));
  } else if (const auto* obstacle = std::get_if<ObstacleSpec>(&thing.what)) {
    painter.setBrush(QColor(140, 140, 150));
    if (obstacle->shape == "cylinder") {
      painter.drawRect(QRectF(9, 8, 14, 19));
      painter.drawEllipse(QRectF(9, 4, 14, 8));
    } else if (obstacle->shape == "ramp") {
      painter.drawPolygon(QPolygonF({{4, 26}, {28, 26}, {28, 10}}));
    } else if (obstacle->mass_kg > 0) {
      painter.drawRect(QRectF(7, 8, 18, 18));
    } else {
      painter.drawRect(QRectF(3, 14, 26, 10));
    }
  } else {
    painter.setBrush(palette.base());
    painter.drawRoundedRect(QRectF(6, 11, 17, 9), 3, 3);
    painter.drawEllipse(QRectF(20, 5, 9, 8));
    painter.drawLine(9, 20, 9, 28);
    painter.drawLine(20, 20, 20, 28);
  }
  return picture;
}

}  // namespace

ThingPalette::ThingPalette(QWidget* parent) : QListWidget(parent), things_(thingsToAdd()) {
  setObjectName("livePalette");
  setAccessibleName(tr("Things to add"));
  setToolTip(tr("Drag one into the view; Return adds it in the middle"));
  setDragEnabled(true);
  setDragDropMode(QAbstractItemView::DragOnly);
  for (const ThingToAdd& thing : things_) addItem(new QListWidgetItem(pictureOf(thing, palette()), thing.text));
  connect(this, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) { emit chosen(row(item)); });
}

void ThingPalette::changeEvent(QEvent* event) {
  QListWidget::changeEvent(event);
  if (event->type() != QEvent::PaletteChange) return;
  for (int i = 0; i < count(); ++i) item(i)->setIcon(pictureOf(thing(i), palette()));
}

QMimeData* ThingPalette::mimeData(const QList<QListWidgetItem*>& items) const {
  auto* data = new QMimeData;
  if (!items.isEmpty()) data->setData(thingMimeType, QByteArray::number(row(items.first())));
  return data;
}

}  // namespace btr::ui
