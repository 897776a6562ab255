#include "ui/live/eye_picture.h"

#include <QPainter>

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
  if (!boxes_) return;
  painter.setPen(QPen(QColor(255, 230, 0), 1));
  for (std::size_t i = 0; i < frame_.seen.size(); ++i) {
    const SeenObject& seen = frame_.seen[i];
    const QRectF box(corner + scale * QPointF(seen.left, seen.top),
                     scale * QSizeF(seen.right - seen.left + 1, seen.bottom - seen.top + 1));
    painter.drawRect(box);
    const QPointF middle = corner + scale * QPointF(seen.centreX_px + 0.5, seen.centreY_px + 0.5);
    painter.drawLine(middle - QPointF(4, 0), middle + QPointF(4, 0));
    painter.drawLine(middle - QPointF(0, 4), middle + QPointF(0, 4));
    constexpr int fewPixels = 40;
    if (seen.pixels >= fewPixels)
      painter.drawText(box.topLeft() + QPointF(2, -3),
                       tr("%1  %2 m").arg(frame_.names[i]).arg(seen.distance_m, 0, 'f', 2));
  }
}

}  // namespace btr::ui
