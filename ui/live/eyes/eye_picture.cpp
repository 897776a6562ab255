#include "ui/live/eyes/eye_picture.h"

#include <QPainter>
#include <algorithm>

#include "ui/live/drawn/label_places.h"

namespace btr::ui {

EyePicture::EyePicture(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Picture of the robot's camera"));
  setObjectName("eyePicture");
  setMinimumSize(104, 80);
}

void EyePicture::setFrame(const ShownFrame& frame) {
  frame_ = frame;
  message_ = frame.image.isNull() ? tr("This stage is off.") : QString();
  update();
}

void EyePicture::setMessage(const QString& text) {
  message_ = text;
  update();
}

void EyePicture::setBoxes(bool on) {
  boxes_ = on;
  update();
}

void EyePicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().window());
  if (!message_.isEmpty() || frame_.image.isNull()) {
    painter.setPen(palette().windowText().color());
    painter.drawText(rect().adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap, message_);
    return;
  }
  const QSizeF pixels = frame_.image.size();
  const double most = std::min(width() / pixels.width(), height() / pixels.height());
  const double scale = most > 1 ? std::floor(most) : most;
  const QPointF corner((width() - scale * pixels.width()) / 2, (height() - scale * pixels.height()) / 2);
  painter.drawImage(QRectF(corner, scale * pixels), frame_.image);
  if (boxes_) drawBoxes(painter, QRectF(corner, scale * pixels));
}

void EyePicture::drawBoxes(QPainter& painter, const QRectF& picture) const {
  const double scale = picture.width() / frame_.image.width();
  const QColor yellow(255, 230, 0), shade(0, 0, 0, 110);
  painter.setPen(QPen(yellow, 1));
  std::vector<std::size_t> named;
  std::vector<QRectF> boxes;
  for (std::size_t i = 0; i < frame_.seen.size(); ++i) {
    const SeenObject& seen = frame_.seen[i];
    boxes.emplace_back(picture.topLeft() + scale * QPointF(seen.left, seen.top),
                       scale * QSizeF(seen.right - seen.left + 1, seen.bottom - seen.top + 1));
    painter.drawRect(boxes.back());
    const QPointF middle = picture.topLeft() + scale * QPointF(seen.centreX_px + 0.5, seen.centreY_px + 0.5);
    painter.drawLine(middle - QPointF(4, 0), middle + QPointF(4, 0));
    painter.drawLine(middle - QPointF(0, 4), middle + QPointF(0, 4));
    constexpr int fewPixels = 40;
    if (seen.pixels >= fewPixels) named.push_back(i);
  }
  // The nearest ones have the first choice.
  std::ranges::stable_sort(named, {}, [this](std::size_t i) { return frame_.seen[i].distance_m; });
  std::vector<LabelledBox> labelled;
  QStringList texts;
  for (const std::size_t i : named) {
    texts << tr("%1  %2 m").arg(frame_.names[i]).arg(frame_.seen[i].distance_m, 0, 'f', 2);
    labelled.push_back({boxes[i], QSizeF(painter.fontMetrics().size(0, texts.back())) + QSizeF(4, 0)});
  }
  const std::vector<QRectF> places = labelPlaces(labelled, picture);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].isNull()) continue;
    const QRectF& box = labelled[i].box;
    if (!places[i].adjusted(-1, -1, 1, 1).intersects(box))  // not beside its box: a line leads there
      painter.drawLine(places[i].bottom() < box.top() ? QLineF(places[i].bottomLeft(), box.topLeft())
                                                      : QLineF(places[i].topLeft(), box.bottomLeft()));
    painter.fillRect(places[i], shade);
    painter.drawText(places[i], Qt::AlignCenter, texts[static_cast<int>(i)]);
  }
}

}  // namespace btr::ui
