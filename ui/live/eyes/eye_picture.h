#pragma once
#include <QWidget>

#include "ui/live/eyes/eye_worker.h"

namespace btr::ui {

/// A camera's frame as large as there is room, with whole pixels; over it the boxes and middles of what is really
/// there.
class EyePicture : public QWidget {
  Q_OBJECT
 public:
  explicit EyePicture(QWidget* parent = nullptr);
  void setFrame(const ShownFrame& frame);
  /// Instead of a picture.
  void setMessage(const QString& text);
  void setBoxes(bool on);
  const ShownFrame& frame() const { return frame_; }
  QSize sizeHint() const override { return {416, 320}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void drawBoxes(QPainter& painter, const QRectF& picture) const;

  ShownFrame frame_;
  QString message_;
  bool boxes_ = true;
};

}  // namespace btr::ui
