#include "ui/live/live_hands.h"

#include "ui/live/hand_acts.h"
#include "ui/live/live_world.h"

namespace btr::ui {

using Eigen::Isometry3d;
using Eigen::Vector3d;

LiveHands::LiveHands(LiveWorld& world, QObject* parent) : QObject(parent), world_(world) {
  connect(&world_, &LiveWorld::forgotten, this, [this] {
    if (!ledFrom_.empty()) world_.process().endGesture();
    ledFrom_.clear();
  });
}

// What is selected is led together, each from where it was.
void LiveHands::lead(const std::string& object, const Vector3d& place_m) {
  if (world_.indexOf(object) < 0) return;
  if (!ledFrom_.contains(object)) {
    world_.process().beginGesture();
    ledFrom_[object] = world_.poseOf(object);
    for (const std::string& other : world_.selection()) ledFrom_[other] = world_.poseOf(other);
  }
  const Vector3d by = place_m - ledFrom_[object].translation();
  for (const auto& [name, from] : ledFrom_) {
    const int index = world_.indexOf(name);
    if (index < 0) continue;
    Isometry3d pose = from;
    pose.translation() += by;
    if (!world_.row().playing)
      world_.act(placeAct(name, pose));
    else if (world_.objects()[std::size_t(index)].moves)
      world_.pullTo(name, pose.translation());
  }
}

void LiveHands::endDrag() {
  for (const auto& led : ledFrom_)
    if (world_.pulls().contains(led.first)) world_.act(LetGoAct{led.first});
  if (!ledFrom_.empty()) world_.process().endGesture();
  ledFrom_.clear();
}

void LiveHands::removeSelected() {
  const std::vector<std::string> objects = world_.selection();
  world_.process().beginGesture();
  for (const std::string& object : objects) world_.act(RemoveAct{object});
  world_.process().endGesture();
}

/// By hand; while the world runs what moves is pulled by a spring, whose other end is moved on.
void LiveHands::move(const Vector3d& by_m, double turn_rad) {
  if (!world_.isReady()) return;
  world_.process().beginGesture();
  for (const std::string& object : world_.selection()) {
    const bool moves = world_.objects()[std::size_t(world_.indexOf(object))].moves;
    Isometry3d pose = world_.poseOf(object);
    if (world_.row().playing && moves && turn_rad == 0) {
      const auto pull = world_.pulls().find(object);
      Vector3d target = pose.translation();
      if (pull != world_.pulls().end())
        target = {pull->second.target_m[0], pull->second.target_m[1], pull->second.target_m[2]};
      world_.pullTo(object, target + by_m);
      continue;
    }
    pose.translation() += by_m;
    pose.linear() = Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ()) * pose.linear();
    world_.act(placeAct(object, pose));
  }
  world_.process().endGesture();
}

void LiveHands::letGo() {
  const auto pulls = world_.pulls();
  world_.process().beginGesture();
  for (const auto& each : pulls) world_.act(LetGoAct{each.first});
  world_.process().endGesture();
}

}  // namespace btr::ui
