#include "ui/scene3d/view_camera.h"

#include <QRectF>
#include <algorithm>
#include <cmath>

namespace btr::ui {
namespace {

/// Columns right, up, back.
Eigen::Matrix3d axes(const ViewCamera& camera) {
  const Eigen::Vector3d back = (camera.eye() - camera.focus).normalized();
  const Eigen::Vector3d right(-std::sin(camera.azimuth), std::cos(camera.azimuth), 0);
  Eigen::Matrix3d result;
  result << right, back.cross(right), back;
  return result;
}

}  // namespace

Eigen::Vector3d ViewCamera::eye() const {
  return focus + distance * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
}

Eigen::Matrix4d ViewCamera::viewMatrix() const {
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  const Eigen::Matrix3d rotation = axes(*this).transpose();
  result.topLeftCorner<3, 3>() = rotation;
  result.topRightCorner<3, 1>() = -rotation * eye();
  return result;
}

double ViewCamera::nearPlane() const { return std::max(0.01, 0.08 * distance); }
double ViewCamera::farPlane() const { return distance + 25; }

std::optional<QPointF> ViewCamera::project(const Eigen::Vector3d& point, QSize size) const {
  const Eigen::Vector4d p = viewMatrix() * point.homogeneous();
  if (p.z() > -nearPlane()) return std::nullopt;
  const double scale = size.height() / (2 * std::tan(fieldOfView / 2) * -p.z());
  return QPointF(size.width() / 2.0 + scale * p.x(), size.height() / 2.0 - scale * p.y());
}

Eigen::Vector3d ViewCamera::ray(QPointF pixel, QSize size) const {
  const double scale = 2 * std::tan(fieldOfView / 2) / std::max(1, size.height());
  const Eigen::Matrix3d frame = axes(*this);
  return (scale * (pixel.x() - size.width() / 2.0) * frame.col(0) -
          scale * (pixel.y() - size.height() / 2.0) * frame.col(1) - frame.col(2))
      .normalized();
}

double ViewCamera::metresPerPixel(int height) const {
  return 2 * distance * std::tan(fieldOfView / 2) / std::max(1, height);
}

void ViewCamera::showWhole(const Eigen::AlignedBox3d& box) {
  constexpr double dog_m = 0.7;
  if (box.isEmpty() || box.diagonal().norm() < dog_m) return;
  focus = box.center();
  distance = std::clamp(box.diagonal().norm() / 2 / std::sin(fieldOfView / 2), distance, 15.0);
}

void ViewCamera::keepInView(const Eigen::Vector3d& point, QSize size) {
  if (size.isEmpty() || !point.allFinite()) return;
  const auto pixel = project(point, size);
  if (!pixel) {  // behind the eye
    focus.head<2>() = point.head<2>();
    return;
  }
  // Shares of the picture around its middle; what goes away from the eye soon is small.
  constexpr double gentle = 0.55, gentleUpright = 0.3, surely = 0.85;
  constexpr double perPicture = 0.12;
  const auto beyond = [](double from, double half, double share) {
    return from - std::clamp(from, -half * share, half * share);
  };
  const auto way = [&](double from, double half, double share) {
    const double some = perPicture * beyond(from, half, share), must = beyond(from, half, surely);
    return std::abs(must) > std::abs(some) ? must : some;
  };
  const double right = way(pixel->x() - size.width() / 2.0, size.width() / 2.0, gentle);
  const double down = way(pixel->y() - size.height() / 2.0, size.height() / 2.0, gentleUpright);
  if (right == 0 && down == 0) return;
  const Eigen::Matrix3d frame = axes(*this);
  const double depth = frame.col(2).dot(eye() - point);
  const double metres = 2 * depth * std::tan(fieldOfView / 2) / size.height();
  // Up and down in the picture is to and fro on the floor, seen at a slant.
  constexpr double flattest = 0.2;
  const double slant = std::copysign(std::max(flattest, std::abs(std::sin(elevation))), elevation);
  const Eigen::Vector3d ahead(-std::cos(azimuth), -std::sin(azimuth), 0);
  focus += metres * (right * frame.col(0) - down / slant * ahead);
  // What was far away.
  const auto now = project(point, size);
  if (!now || !QRectF(QPointF(), QSizeF(size)).contains(*now)) focus.head<2>() = point.head<2>();
}

void ViewCamera::orbit(QPointF pixels) {
  constexpr double radiansPerPixel = 0.006;
  azimuth = std::remainder(azimuth - radiansPerPixel * pixels.x(), 2 * std::numbers::pi);
  elevation = std::clamp(elevation + radiansPerPixel * pixels.y(), -0.2, 1.55);
}

void ViewCamera::pan(QPointF pixels, int height) {
  const Eigen::Matrix3d frame = axes(*this);
  focus += metresPerPixel(height) * (-pixels.x() * frame.col(0) + pixels.y() * frame.col(1));
}

void ViewCamera::zoom(double steps) { distance = std::clamp(distance * std::pow(1.15, -steps), 0.08, 15.0); }

}  // namespace btr::ui
