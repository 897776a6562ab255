#include "ui/live/live_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <cmath>

#include "ui/common/theme.h"

namespace btr::ui {

using Eigen::Vector3d;

namespace {

/// Way along the ray (unit length) to a box about the pose; negative if it passes by.
double wayToBox(const Eigen::Isometry3d& pose, const Vector3d& half, const Vector3d& eye, const Vector3d& ray) {
  const Vector3d from = pose.inverse() * eye, along = pose.linear().transpose() * ray;
  double enter = 0, leave = 1e30;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(along[i]) < 1e-12) {
      if (std::abs(from[i]) > half[i]) return -1;
      continue;
    }
    const double a = (-half[i] - from[i]) / along[i], b = (half[i] - from[i]) / along[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : -1;
}

}  // namespace

LiveView::LiveView(QWidget* parent, GlContextFactory factory) : SceneView(parent, std::move(factory)) {
  setAccessibleName(tr("3D view of the running world"));
  setObjectName("liveView");
}

void LiveView::setScene(const LiveScene& scene) {
  scene_ = scene;
  setRobot(nullptr);
  setFurtherRobots(scene.models());
  setFurtherJackets(scene.jackets());
  setBalls(scene.radii());
  setCarpet(scene.carpet());
  led_ = -1;
}

void LiveView::setRow(const LiveRow& row) {
  row_ = row;
  if (following_)
    for (std::size_t i = 0; i < scene_.objects().size(); ++i)
      if (scene_.objects()[i].name == selected_) {
        ViewCamera camera = this->camera();
        camera.focus = scene_.poseOf(i, row).translation();
        setCamera(camera);
      }
  setPose(scene_.pose(row));
}

void LiveView::select(const std::string& object) {
  selected_ = object;
  update();
}

void LiveView::setFollowing(bool on) {
  following_ = on;
  if (on && !row_.values.empty()) setRow(row_);
}

int LiveView::objectAt(QPointF pixel) const {
  if (row_.values.empty()) return -1;
  const Vector3d eye = camera().eye(), ray = camera().ray(pixel, size());
  int best = -1;
  double nearest = 1e30;
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const Eigen::Isometry3d pose = scene_.poseOf(i, row_);
    if (const Vector3d& half = scene_.objects()[i].half_m; half.z() > 0) {
      if (const double way = wayToBox(pose, half, eye, ray); way > 0 && way < nearest) {
        nearest = way;
        best = static_cast<int>(i);
      }
      continue;
    }
    const Vector3d to = pose.translation() - eye;
    const double along = to.dot(ray), aside = (to - along * ray).norm();
    // A small ball far away can still be hit.
    const double reach = std::max(scene_.objects()[i].radius_m,
                                  6 * camera().metresPerPixel(height()) * along / std::max(1e-6, camera().distance));
    if (along <= 0 || aside > reach || along > nearest) continue;
    nearest = along;
    best = static_cast<int>(i);
  }
  return best;
}

std::optional<Vector3d> LiveView::onPlane(QPointF pixel, double height) const {
  const Vector3d eye = camera().eye(), ray = camera().ray(pixel, size());
  if (std::abs(ray.z()) < 1e-3) return std::nullopt;
  const double way = (height - eye.z()) / ray.z();
  constexpr double furthest_m = 30;
  if (way <= 0 || way > furthest_m) return std::nullopt;
  return Vector3d(eye + way * ray);
}

void LiveView::mousePressEvent(QMouseEvent* event) {
  const int object =
      event->button() == Qt::LeftButton && !(event->modifiers() & Qt::ShiftModifier) ? objectAt(event->position()) : -1;
  if (object < 0) return SceneView::mousePressEvent(event);
  setFocus(Qt::MouseFocusReason);
  place_m_ = scene_.poseOf(std::size_t(object), row_).translation();
  const auto under = onPlane(event->position(), place_m_.z());
  grip_m_ = under ? Vector3d(place_m_ - *under) : Vector3d(Vector3d::Zero());
  led_ = object;
  moved_ = false;
  last_ = event->position();
  select(scene_.objects()[std::size_t(object)].name);
  emit picked(selected_);
}

void LiveView::mouseMoveEvent(QMouseEvent* event) {
  if (led_ < 0) return SceneView::mouseMoveEvent(event);
  constexpr double tremble_px = 3;
  if (!moved_ && (event->position() - last_).manhattanLength() < tremble_px) return;
  moved_ = true;
  if (event->modifiers() & Qt::ControlModifier) {
    place_m_.z() -= (event->position().y() - last_.y()) * camera().metresPerPixel(height());
    const auto under = onPlane(event->position(), place_m_.z());
    if (under) grip_m_ = Vector3d(place_m_.x() - under->x(), place_m_.y() - under->y(), 0);
  } else if (const auto under = onPlane(event->position(), place_m_.z())) {
    place_m_.head<2>() = (*under + grip_m_).head<2>();
  }
  last_ = event->position();
  emit ledTo(selected_, place_m_);
  update();
}

void LiveView::mouseReleaseEvent(QMouseEvent* event) {
  if (led_ < 0 || event->button() != Qt::LeftButton) return SceneView::mouseReleaseEvent(event);
  led_ = -1;
  if (moved_) emit letGo(selected_);
  update();
}

// A ring around what is selected, a line to where it is led.
void LiveView::paintEvent(QPaintEvent* event) {
  SceneView::paintEvent(event);
  if (row_.values.empty()) return;
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const LiveObject& object = scene_.objects()[i];
    if (object.name != selected_) continue;
    const Vector3d at = scene_.poseOf(i, row_).translation();
    const auto centre = camera().project(at, size());
    if (!centre) return;
    const double depth = (at - camera().eye()).norm();
    const double pixels = object.radius_m * height() / (2 * std::tan(camera().fieldOfView / 2) * std::max(0.05, depth));
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette().highlight().color(), 2));
    painter.drawEllipse(*centre, pixels * 1.15, pixels * 1.15);
    if (led_ >= 0 && moved_)
      if (const auto led = camera().project(place_m_, size())) painter.drawLine(*centre, *led);
  }
}

}  // namespace btr::ui
