#pragma once
#include <Eigen/Geometry>
#include <QPointF>
#include <QSize>
#include <numbers>
#include <optional>

namespace btr::ui {

/// Where the scene is looked at from: a camera that circles a focus, z up. A plain value; angles in rad, lengths in m.
struct ViewCamera {
  Eigen::Vector3d focus{0.08, 0, 0.10};
  double distance = 1.15;
  double azimuth = -0.90;                            ///< of the eye as seen from the focus, from +x towards +y
  double elevation = 0.36;                           ///< of the eye above the focus, −0.2 … 1.55
  double fieldOfView = 32 * std::numbers::pi / 180;  ///< vertical

  Eigen::Vector3d eye() const;
  /// World → camera (x right, y up, −z ahead).
  Eigen::Matrix4d viewMatrix() const;
  double nearPlane() const;
  double farPlane() const;
  /// Pixel of a point in the world, from the picture's upper left corner; nothing if it lies behind the eye.
  std::optional<QPointF> project(const Eigen::Vector3d& point, QSize size) const;
  /// Direction from the eye through a pixel, unit length, world.
  Eigen::Vector3d ray(QPointF pixel, QSize size) const;
  /// Metres that one pixel spans at the focus.
  double metresPerPixel(int height) const;

  /// Where it looks from the same side, a box that is larger than a dog is seen whole; smaller ones change nothing.
  void showWhole(const Eigen::AlignedBox3d& box);
  /// Goes along over the floor, so that a point does not leave a picture of that size: at once as far as it would be
  /// out, gently (some of the way with each picture) as it comes near the edge.
  void keepInView(const Eigen::Vector3d& point, QSize size);
  /// Mouse movements in pixels of a view of that height.
  void orbit(QPointF pixels);
  void pan(QPointF pixels, int height);
  /// Positive steps come closer, by a factor of 1.15 each; 0.08 m … 15 m.
  void zoom(double steps);
  bool operator==(const ViewCamera&) const = default;
};

}  // namespace btr::ui
