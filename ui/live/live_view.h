#pragma once
#include <optional>

#include "ui/live/live_scene.h"
#include "ui/scene3d/scene_view.h"

namespace btr::ui {

/// The 3D view of a running world: objects are picked and dragged with the left button; where none is, the view turns.
/// A dragged object is led over the floor at the height at which it was taken, with Ctrl up and down instead.
class LiveView : public SceneView {
  Q_OBJECT
 public:
  explicit LiveView(QWidget* parent = nullptr, GlContextFactory factory = createGlContext);

  void setScene(const LiveScene& scene);
  void setRow(const LiveRow& row);
  void select(const std::string& object);  ///< "" none
  const std::string& selected() const { return selected_; }
  /// Keeps what is selected in the middle.
  void setFollowing(bool on);

  /// The object under a pixel, the nearest one to the eye; −1 none.
  int objectAt(QPointF pixel) const;

 signals:
  void picked(const std::string& object);
  /// It was taken and is led to a place in the world (of its frame's origin).
  void ledTo(const std::string& object, const Eigen::Vector3d& place_m);
  void letGo(const std::string& object);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  std::optional<Eigen::Vector3d> onPlane(QPointF pixel, double height) const;

  LiveScene scene_;
  LiveRow row_;
  std::string selected_;
  int led_ = -1;                                       ///< object that is dragged
  Eigen::Vector3d grip_m_ = Eigen::Vector3d::Zero();   ///< from the place under the mouse to the object's
  Eigen::Vector3d place_m_ = Eigen::Vector3d::Zero();  ///< where it is led
  QPointF last_;
  bool moved_ = false, following_ = false;
};

}  // namespace btr::ui
