#include "ui/live/drawn/live_scene.h"

#include <algorithm>

#include "core/model/kinematics.h"
#include "core/sim/contact/obstacle_shape.h"
#include "ui/live/free_place.h"
#include "ui/scene3d/link_boxes.h"

namespace btr::ui {
namespace {

using Eigen::Isometry3d;

std::shared_ptr<const RobotModel> modelOf(const ObstacleSpec& spec) {
  auto model = std::make_shared<RobotModel>();
  model->name = spec.name;
  Link link;
  link.name = spec.name;
  link.shapes = {obstacleShape(spec)};
  model->links = {link};
  return model;
}

Eigen::Vector3d halfOf(const ObstacleSpec& spec) {
  const double r = spec.radius_m;
  if (spec.shape == "sphere") return {r, r, r};
  if (spec.shape == "cylinder") return {r, r, spec.size_m[2] / 2};
  return Eigen::Vector3d(spec.size_m[0], spec.size_m[1], spec.size_m[2]) / 2;
}

}  // namespace

LiveScene::LiveScene(const Game& game, const ModelSet& models, const std::vector<std::string>& channels) {
  const auto column = [&](const std::string& name) {
    const auto found = std::ranges::find(channels, name);
    return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
  };
  carpet_ = game.pitch.carpet;
  for (const RobotSpec& robot : game.scene.robots) {
    const auto& model = models.at(robot.model);
    numbers_.push_back(robots_.size());
    Columns columns{column(robot.name + ".base.x_m"), {}};
    for (const Joint& joint : model->joints) {
      const int angle = column(robot.name + "." + joint.name + ".position_rad");
      columns.joints.push_back(angle >= 0 ? angle : column(robot.name + "." + joint.name + ".position_m"));
    }
    robots_.push_back(std::move(columns));
    models_.push_back(model);
    const auto player = game.robots.find(robot.name);
    jackets_.push_back(player == game.robots.end() || player->second.team.empty() ? "red" : player->second.team);
    boxes_.push_back(btr::ui::linkBoxes(*model));
    const std::vector<double> atZero(model->joints.size(), 0.0);
    const Eigen::AlignedBox3d box = boxOf(boxes_.back(), forwardKinematics(*model, Isometry3d::Identity(), atZero));
    // What holds a dog with its head and paws, and most of it; a larger robot in proportion.
    constexpr double dog_m = 0.13;
    double covers_m = dogRadius_m;
    if (!box.isEmpty()) covers_m = std::max(covers_m, 0.7 * box.sizes().head<2>().norm());
    objects_.push_back({robot.name,
                        LiveObject::Kind::robot,
                        dog_m * covers_m / dogRadius_m,
                        {0, 0, 0},
                        robot.base == "free",
                        covers_m});
  }
  for (const BallSpec& ball : game.scene.balls) {
    numbers_.push_back(balls_.size());
    balls_.push_back(column(ball.name + ".x_m"));
    radii_.push_back(ball.radius_m);
    objects_.push_back({ball.name, LiveObject::Kind::ball, ball.radius_m, {0, 0, 0}, true});
  }
  for (const ObstacleSpec& obstacle : game.scene.obstacles) {
    numbers_.push_back(obstacles_.size());
    obstacles_.push_back(column(obstacle.name + ".x_m"));
    models_.push_back(modelOf(obstacle));
    jackets_.emplace_back("red");
    constexpr double largestRing_m = 0.3;
    const Eigen::Vector3d half = halfOf(obstacle);
    objects_.push_back(
        {obstacle.name, LiveObject::Kind::obstacle, std::min(largestRing_m, half.norm()), half, obstacle.mass_kg > 0});
  }
}

Isometry3d LiveScene::read(const LiveRow& row, int column) const {
  const auto at = [&](int i) { return row.values[static_cast<std::size_t>(column + i)]; };
  if (column < 0 || static_cast<std::size_t>(column) + 7 > row.values.size()) return Isometry3d::Identity();
  return Eigen::Translation3d(at(0), at(1), at(2)) * Eigen::Quaterniond(at(3), at(4), at(5), at(6)).normalized();
}

Isometry3d LiveScene::poseOf(std::size_t object, const LiveRow& row) const {
  const std::size_t number = numbers_[object];
  if (objects_[object].kind == LiveObject::Kind::robot) return read(row, robots_[number].pose);
  if (objects_[object].kind == LiveObject::Kind::ball) return read(row, balls_[number]);
  if (obstacles_[number] >= 0) return read(row, obstacles_[number]);
  for (const auto& [index, pose] : row.fixed)
    if (index == number) return pose;
  return Isometry3d::Identity();
}

LiveRow LiveScene::between(const LiveRow& from, const LiveRow& to, double part) const {
  LiveRow row = from;
  if (from.values.size() != to.values.size()) return row;
  for (std::size_t i = 0; i < row.values.size(); ++i) row.values[i] += part * (to.values[i] - from.values[i]);
  const auto turn = [&](int column) {
    if (column < 0) return;
    const auto at = [column](const LiveRow& of) {
      const double* q = &of.values.at(static_cast<std::size_t>(column) + 3);
      return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    };
    const Eigen::Quaterniond q = at(from).slerp(part, at(to));
    const double parts[] = {q.w(), q.x(), q.y(), q.z()};
    std::copy(parts, parts + 4, row.values.begin() + column + 3);
  };
  for (const Columns& robot : robots_) turn(robot.pose);
  for (const int column : balls_) turn(column);
  for (const int column : obstacles_) turn(column);
  return row;
}

Values LiveScene::jointsOf(std::size_t object, const LiveRow& row) const {
  Values joints;
  if (objects_[object].kind != LiveObject::Kind::robot) return joints;
  const std::size_t number = numbers_[object];
  for (std::size_t j = 0; j < robots_[number].joints.size(); ++j)
    if (const int column = robots_[number].joints[j]; column >= 0 && std::size_t(column) < row.values.size())
      joints[models_[number]->joints[j].name] = row.values[static_cast<std::size_t>(column)];
  return joints;
}

std::vector<Isometry3d> LiveScene::linksOf(std::size_t object, const LiveRow& row) const {
  const std::size_t number = numbers_[object];
  std::vector<double> joints;
  for (const int column : robots_[number].joints)
    joints.push_back(column < 0 ? 0 : row.values.at(static_cast<std::size_t>(column)));
  return forwardKinematics(*models_[number], poseOf(object, row), joints);
}

Eigen::AlignedBox3d LiveScene::box(const LiveRow& row) const {
  Eigen::AlignedBox3d all;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    all.extend(poseOf(i, row).translation());
    if (objects_[i].kind == LiveObject::Kind::robot) all.extend(boxOf(boxes_[numbers_[i]], linksOf(i, row)));
  }
  return all;
}

ScenePose LiveScene::pose(const LiveRow& row) const {
  ScenePose pose;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const Isometry3d own = poseOf(i, row);
    if (objects_[i].kind == LiveObject::Kind::ball) {
      pose.balls.push_back(own);
    } else if (objects_[i].kind == LiveObject::Kind::obstacle) {
      pose.others.push_back({own});
    } else {
      pose.others.push_back(linksOf(i, row));
    }
  }
  return pose;
}

}  // namespace btr::ui
