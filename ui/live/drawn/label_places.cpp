#include "ui/live/drawn/label_places.h"

#include <algorithm>
#include <cmath>

namespace btr::ui {
namespace {

/// Straight up and down from a place in steps of the label's height, the nearest first, until it has left the picture.
std::vector<QRectF> upAndDown(const QRectF& from, const QRectF& picture) {
  std::vector<QRectF> places;
  const int steps = static_cast<int>(std::ceil(picture.height() / from.height()));
  for (int step = 1; step <= steps; ++step)
    for (const int side : {-1, 1}) places.push_back(from.translated(0, side * step * from.height()));
  return places;
}

/// What may be moved into the picture is.
QRectF movedInto(const QRectF& picture, QRectF place) {
  place.moveLeft(std::max(picture.left(), std::min(place.left(), picture.right() - place.width())));
  return place;
}

}  // namespace

std::vector<QRectF> labelPlaces(const std::vector<LabelledBox>& boxes, const QRectF& picture) {
  std::vector<QRectF> taken;
  for (const auto& [box, size] : boxes) {
    const QRectF above(QPointF(box.left(), box.top() - size.height()), size);
    std::vector<QRectF> wanted{above,
                               {QPointF(box.left(), box.bottom()), size},
                               {box.topLeft(), size},
                               {QPointF(box.right(), box.top()), size},
                               {QPointF(box.left() - size.width(), box.top()), size}};
    for (const QRectF& further : upAndDown(above, picture)) wanted.push_back(further);
    QRectF place;
    for (const QRectF& each : wanted) {
      const QRectF inside = movedInto(picture, each);
      if (!picture.contains(inside)) continue;
      if (std::any_of(taken.begin(), taken.end(), [&](const QRectF& other) { return other.intersects(inside); }))
        continue;
      place = inside;
      break;
    }
    taken.push_back(place);
  }
  return taken;
}

}  // namespace btr::ui
