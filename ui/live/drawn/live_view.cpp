#include "ui/live/drawn/live_view.h"

#include <QDragEnterEvent>
#include <QMimeData>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/common/look/theme.h"
#include "ui/live/drawn/lamp_places.h"

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
  setAcceptDrops(true);
}

void LiveView::setScene(const LiveScene& scene) {
  scene_ = scene;
  setRobot(nullptr);
  setFurtherRobots(scene.models());
  setFurtherJackets(scene.jackets());
  setBalls(scene.radii());
  setCarpet(scene.carpet());
  trails_.clear();
  led_ = -1;
}

void LiveView::setRow(const LiveRow& row) {
  row_ = row;
  if (following_)
    for (std::size_t i = 0; i < scene_.objects().size(); ++i)
      if (scene_.objects()[i].name == selected()) {
        ViewCamera camera = this->camera();
        camera.focus = scene_.poseOf(i, row).translation();
        setCamera(camera);
      }
  const bool trails = markAction(Mark::trails)->isChecked();
  if (!trails) trails_.clear();
  if (trails) trails_.add(scene_, row);
  if (trails || markAction(Mark::contacts)->isChecked()) setWorldMarks({row.contacts, trails_.ways()});
  setPose(scene_.pose(row));
}

std::optional<Vector3d> LiveView::keptInView() const {
  if (row_.values.empty() || led_ >= 0 || following_) return std::nullopt;
  Vector3d sum = Vector3d::Zero();
  int robots = 0;
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const LiveObject& object = scene_.objects()[i];
    if (object.name == selected()) return scene_.poseOf(i, row_).translation();
    if (object.kind != LiveObject::Kind::robot) continue;
    sum += scene_.poseOf(i, row_).translation();
    ++robots;
  }
  if (robots == 0) return std::nullopt;
  return sum / robots;
}

void LiveView::select(std::vector<std::string> objects) {
  selected_ = std::move(objects);
  update();
}

void LiveView::setHands(std::map<std::string, Vector3d> targets_m) {
  hands_ = std::move(targets_m);
  update();
}

std::optional<Eigen::Vector2d> LiveView::onFloor(QPointF pixel) const {
  const auto at = onPlane(pixel, 0);
  if (!at) return std::nullopt;
  return Eigen::Vector2d(at->x(), at->y());
}

void LiveView::setFollowing(bool on) {
  following_ = on;
  if (on && !row_.values.empty()) setRow(row_);
}

ViewCamera LiveView::homeCamera() const {
  ViewCamera camera;
  if (row_.values.empty()) return camera;
  Eigen::AlignedBox3d places;
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) places.extend(scene_.poseOf(i, row_).translation());
  if (places.isEmpty()) return camera;
  camera.focus = places.center();
  constexpr double perRadius = 2.2;
  camera.distance = std::clamp(perRadius * (places.diagonal().norm() / 2 + 0.3), camera.distance, 15.0);
  // Robots may be larger than dogs.
  if (const Eigen::AlignedBox3d all = scene_.box(row_); all.diagonal().norm() > places.diagonal().norm() + 0.7)
    camera.showWhole(all);
  if (camera.distance > 3) camera.elevation = 0.6;
  return camera;
}

double LiveView::wayToRobot(std::size_t object, const Vector3d& eye, const Vector3d& ray) const {
  const std::vector<Eigen::AlignedBox3d>& boxes = scene_.linkBoxes(object);
  const std::vector<Eigen::Isometry3d> links = scene_.linksOf(object, row_);
  double nearest = -1;
  for (std::size_t l = 0; l < boxes.size(); ++l) {
    if (boxes[l].isEmpty()) continue;
    const Eigen::Isometry3d centre = links[l] * Eigen::Translation3d(boxes[l].center());
    const double way = wayToBox(centre, boxes[l].sizes() / 2, eye, ray);
    if (way > 0 && (nearest < 0 || way < nearest)) nearest = way;
  }
  return nearest;
}

int LiveView::objectAt(QPointF pixel) const {
  if (row_.values.empty()) return -1;
  const Vector3d eye = camera().eye(), ray = camera().ray(pixel, size());
  int best = -1;
  double nearest = 1e30;
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const Eigen::Isometry3d pose = scene_.poseOf(i, row_);
    if (scene_.objects()[i].kind == LiveObject::Kind::robot)
      if (const double way = wayToRobot(i, eye, ray); way > 0 && way < nearest) {
        nearest = way;
        best = static_cast<int>(i);
        continue;
      }
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
  const int object = event->button() == Qt::LeftButton ? objectAt(event->position()) : -1;
  if (object < 0) return SceneView::mousePressEvent(event);
  setFocus(Qt::MouseFocusReason);
  place_m_ = scene_.poseOf(std::size_t(object), row_).translation();
  const auto under = onPlane(event->position(), place_m_.z());
  grip_m_ = under ? Vector3d(place_m_ - *under) : Vector3d(Vector3d::Zero());
  led_ = object;
  moved_ = false;
  last_ = event->position();
  // What is selected together is led together.
  const std::string& name = scene_.objects()[std::size_t(object)].name;
  wasSelected_ = std::ranges::find(selected_, name) != selected_.end();
  if (!wasSelected_) emit picked(name, event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier));
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
  emit ledTo(scene_.objects()[std::size_t(led_)].name, place_m_);
  update();
}

void LiveView::mouseReleaseEvent(QMouseEvent* event) {
  if (led_ < 0 || event->button() != Qt::LeftButton) return SceneView::mouseReleaseEvent(event);
  const std::string name = scene_.objects()[std::size_t(std::exchange(led_, -1))].name;
  if (moved_)
    emit letGo(name);
  else if (wasSelected_)
    emit picked(name, event->modifiers() & (Qt::ControlModifier | Qt::ShiftModifier));
  update();
}

void LiveView::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasFormat(thingMimeType)) event->acceptProposedAction();
}

void LiveView::dragMoveEvent(QDragMoveEvent* event) {
  drop_ = event->position();
  event->setAccepted(onFloor(*drop_).has_value());
  update();
}

void LiveView::dragLeaveEvent(QDragLeaveEvent*) {
  drop_.reset();
  update();
}

void LiveView::dropEvent(QDropEvent* event) {
  drop_.reset();
  update();
  const auto at = onFloor(event->position());
  if (!at || !event->mimeData()->hasFormat(thingMimeType)) return event->ignore();
  event->acceptProposedAction();
  emit dropped(event->mimeData()->data(thingMimeType).toInt(), *at);
}

// Rings around what is selected, lines to where hands pull, with their force.
void LiveView::paintEvent(QPaintEvent* event) {
  SceneView::paintEvent(event);
  if (row_.values.empty()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paintLamps(painter);
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const LiveObject& object = scene_.objects()[i];
    const Vector3d at = scene_.poseOf(i, row_).translation();
    if (std::ranges::find(selected_, object.name) != selected_.end()) paintRing(painter, object, at);
    if (const auto hand = hands_.find(object.name); hand != hands_.end())
      paintHand(painter, object.name, at, hand->second);
    else if (led_ == int(i) && moved_)
      paintHand(painter, object.name, at, place_m_);
  }
  if (!drop_) return;
  painter.setPen(QPen(palette().highlight().color(), 2));
  painter.drawEllipse(*drop_, 12, 6);
}

// Over the picture, where their side of the robot faces the eye: light, no bodies. Robots' cameras do not see them.
void LiveView::paintLamps(QPainter& painter) {
  if (row_.orders.empty()) return;
  const ScenePose pose = scene_.pose(row_);
  painter.setPen(Qt::NoPen);
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) {
    const auto orders = row_.orders.find(scene_.objects()[i].name);
    if (orders == row_.orders.end() || i >= scene_.models().size()) continue;
    const RobotModel& model = *scene_.models()[i];
    for (const LampSpot& spot : lampSpots(model.name)) {
      const QColor colour = shining(spot, orders->second);
      const int link = model.findLink(spot.link);
      if (!colour.isValid() || link < 0) continue;
      const Eigen::Isometry3d& at = pose.others.at(i).at(static_cast<std::size_t>(link));
      const Vector3d place = at * spot.place_m, way = camera().eye() - place;
      const auto pixel = camera().project(place, size());
      if (!pixel || way.dot(at.linear() * spot.outward) <= 0) continue;
      constexpr double radius_m = 0.0035, least_px = 1.5, glow = 2.2;
      const double radius = std::max(
          least_px, radius_m * height() / (2 * std::tan(camera().fieldOfView / 2) * std::max(0.05, way.norm())));
      QRadialGradient light(*pixel, glow * radius);
      QColor rim = colour;
      rim.setAlpha(0);
      light.setColorAt(0, colour);
      light.setColorAt(1 / glow, colour);
      light.setColorAt(1, rim);
      painter.setBrush(light);
      painter.drawEllipse(*pixel, glow * radius, glow * radius);
    }
  }
  painter.setBrush(Qt::NoBrush);
}

void LiveView::paintRing(QPainter& painter, const LiveObject& object, const Vector3d& at) {
  const auto centre = camera().project(at, size());
  if (!centre) return;
  const double depth = (at - camera().eye()).norm();
  const double pixels = object.radius_m * height() / (2 * std::tan(camera().fieldOfView / 2) * std::max(0.05, depth));
  painter.setPen(QPen(palette().highlight().color(), object.name == selected() ? 2 : 1));
  painter.drawEllipse(*centre, pixels * 1.15, pixels * 1.15);
}

void LiveView::paintHand(QPainter& painter, const std::string& object, const Vector3d& from, const Vector3d& to) {
  const auto begin = camera().project(from, size()), end = camera().project(to, size());
  if (!begin || !end) return;
  painter.setPen(QPen(palette().highlight().color(), 2));
  painter.drawLine(*begin, *end);
  painter.drawEllipse(*end, 3, 3);
  const auto force = row_.hands_n.find(object);
  if (force == row_.hands_n.end()) return;
  const QString text = tr("%1 N").arg(force->second.norm(), 0, 'f', 1);
  QRectF box = painter.fontMetrics().boundingRect(text);
  box = box.adjusted(-4, -2, 4, 2).translated(*end + QPointF(10, -6));
  painter.fillRect(box, palette().toolTipBase());
  painter.setPen(palette().toolTipText().color());
  painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace btr::ui
