#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ui/live/drawn/live_scene.h"
#include "ui/live/drawn/live_trails.h"
#include "ui/scene3d/scene_view.h"

namespace btr::ui {

/// What a palette's drag carries: the number of a thing as text.
inline constexpr const char* thingMimeType = "application/x-uchilsim-thing";

/// The 3D view of a running world: objects are picked and dragged with the left button; where none is, the view turns.
/// With Ctrl or Shift a click adds to what is selected.
/// A dragged object is led over the floor at the height at which it was taken, with Ctrl up and down instead.
class LiveView : public SceneView {
  Q_OBJECT
 public:
  explicit LiveView(QWidget* parent = nullptr, GlContextFactory factory = createGlContext);

  void setScene(const LiveScene& scene);
  void setRow(const LiveRow& row);
  /// The last one is followed and shown by panels.
  void select(std::vector<std::string> objects);
  std::string selected() const { return selected_.empty() ? "" : selected_.back(); }
  /// Where hands pull objects to (world): drawn as lines, with the row's forces.
  void setHands(std::map<std::string, Eigen::Vector3d> targets_m);
  /// Of the floor under a pixel; nothing where the ray does not meet it.
  std::optional<Eigen::Vector2d> onFloor(QPointF pixel) const;
  /// Keeps what is selected in the middle.
  void setFollowing(bool on);

  /// From above one corner, near enough to see a dog and far enough to see all.
  ViewCamera homeCamera() const override;

  /// The object under a pixel, the nearest one to the eye; −1 none.
  int objectAt(QPointF pixel) const;

 signals:
  /// With `toggle` it is added to what is selected, or taken out.
  void picked(const std::string& object, bool toggle);
  /// It was taken and is led to a place in the world (of its frame's origin).
  void ledTo(const std::string& object, const Eigen::Vector3d& place_m);
  void letGo(const std::string& object);
  /// Something of a palette was dropped on the floor: its number there.
  void dropped(int thing, const Eigen::Vector2d& at_m);

 protected:
  /// What is selected, or else the middle of all robots. While something is led by the mouse the picture stands.
  std::optional<Eigen::Vector3d> keptInView() const override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  /// Along a ray of unit length; negative if it passes by.
  double wayToRobot(std::size_t object, const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) const;
  void paintRing(QPainter& painter, const LiveObject& object, const Eigen::Vector3d& at);
  void paintLamps(QPainter& painter);
  void paintHand(QPainter& painter, const std::string& object, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  std::optional<Eigen::Vector3d> onPlane(QPointF pixel, double height) const;

  LiveScene scene_;
  LiveRow row_;
  std::vector<std::string> selected_;
  std::map<std::string, Eigen::Vector3d> hands_;
  std::optional<QPointF> drop_;                        ///< where something is held over the view
  int led_ = -1;                                       ///< object that is dragged
  Eigen::Vector3d grip_m_ = Eigen::Vector3d::Zero();   ///< from the place under the mouse to the object's
  Eigen::Vector3d place_m_ = Eigen::Vector3d::Zero();  ///< where it is led
  QPointF last_;
  LiveTrails trails_;
  bool moved_ = false, following_ = false;
  bool wasSelected_ = false;  ///< the one under the mouse, before it was pressed
};

}  // namespace btr::ui
