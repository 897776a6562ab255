#pragma once
#include <QRectF>
#include <vector>

namespace btr::ui {

/// A box in a picture, and the room that its label takes.
struct LabelledBox {
  QRectF box;
  QSizeF label;
};

/// Where the labels go: no two overlap, none leaves the picture. At the box where that is free, above it at best, else
/// straight above or below as near as can be; a null rectangle where there is no room. The first ones choose first.
std::vector<QRectF> labelPlaces(const std::vector<LabelledBox>& boxes, const QRectF& picture);

}  // namespace btr::ui
