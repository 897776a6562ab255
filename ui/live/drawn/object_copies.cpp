#include "ui/live/drawn/object_copies.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <algorithm>

#include "ui/common/numbers/format.h"
#include "ui/live/free_place.h"
#include "ui/live/hand_acts.h"
#include "ui/live/live_world.h"

namespace btr::ui {
namespace {

using Eigen::Isometry3d;

QString copyText(const char* text) { return QCoreApplication::translate("ObjectCopies", text); }

template <class Spec>
Spec placedAt(Spec spec, const std::string& name, const PlaceAct& place) {
  spec.name = name;
  spec.position_m = place.position_m;
  if constexpr (requires { spec.orientation_wxyz; }) spec.orientation_wxyz = place.orientation_wxyz;
  return spec;
}

/// The acts that add it as it is now, under another name and elsewhere.
std::vector<Act> copyOf(const LiveWorld& world, const std::string& object, const std::string& name,
                        const Isometry3d& pose) {
  const SceneSpec& scene = world.game().scene;
  PlaceAct place = placeAct(name, pose);
  AddAct add;
  for (const BallSpec& ball : scene.balls)
    if (ball.name == object) {
      BallSpec resting = placedAt(ball, name, place);
      resting.velocity_m_s = resting.spin_rad_s = {};
      add.what = resting;
    }
  for (const ObstacleSpec& obstacle : scene.obstacles)
    if (obstacle.name == object) {
      ObstacleSpec resting = placedAt(obstacle, name, place);
      resting.velocity_m_s = resting.spin_rad_s = {};
      add.what = resting;
    }
  for (const RobotSpec& robot : scene.robots) {
    if (robot.name != object) continue;
    add.what = placedAt(robot, name, place);
    add.player = world.playerOf(object);
    // A controller's posture is not the one it has now.
    place.joints = world.scene().jointsOf(std::size_t(world.indexOf(object)), world.row());
    return {add, place};
  }
  return {add};
}

bool isNamedBySimulator(const LiveWorld& world, const std::string& object) {
  const auto names = [&](const SimulatorSpec& simulator) {
    return std::ranges::any_of(simulator.values,
                               [&](const auto& value) {
                                 return value.first.starts_with("robots." + object + ".") ||
                                        value.first.starts_with("balls." + object + ".");
                               }) ||
           std::ranges::any_of(simulator.effects, [&](const PlacedEffect& effect) {
             return effect.at == object || effect.at.starts_with(object + ".");
           });
  };
  if (names(world.game().simulator)) return true;
  return std::ranges::any_of(world.game().robots, [&](const auto& player) {
    return player.second.simulator && names(*player.second.simulator);
  });
}

double radiusOf(const LiveObject& object) {
  if (object.kind == LiveObject::Kind::robot) return object.footprint_m;
  return object.kind == LiveObject::Kind::ball ? object.radius_m : object.half_m.head<2>().norm();
}

}  // namespace

void duplicateSelected(LiveWorld& world) {
  std::vector<Footprint> taken = footprintsOf(world);
  std::vector<std::string> names;
  world.process().beginGesture();
  for (const std::string& object : std::vector<std::string>(world.selection())) {
    const LiveObject& original = world.objects()[std::size_t(world.indexOf(object))];
    const double radius = radiusOf(original);
    Isometry3d pose = world.poseOf(object);
    pose.translation().head<2>() = freePlace(taken, pose.translation().head<2>(), radius);
    Footprint print;
    print.at = pose.translation().head<2>();
    print.radius_m = radius;
    taken.push_back(print);
    // "ball2" gives "ball3".
    std::string base = object;
    while (base.size() > 1 && base.back() >= '0' && base.back() <= '9') base.pop_back();
    names.push_back(world.freeName(base));
    world.selectLater(names);
    for (const Act& act : copyOf(world, object, names.back(), pose)) world.act(act);
  }
  world.process().endGesture();
}

QString renameObject(LiveWorld& world, const std::string& object, const std::string& name) {
  static const QRegularExpression allowed("^[A-Za-z0-9_-]{1,60}$");
  if (!allowed.match(word(name)).hasMatch())
    return copyText("“%1” is no name: letters, digits, _ and - are allowed.").arg(word(name));
  if (world.indexOf(name) >= 0) return copyText("Another object has the name “%1”.").arg(word(name));
  if (isNamedBySimulator(world, object))
    return copyText("A number or an effect of the simulator names %1: take it away first.").arg(word(object));
  const std::vector<Act> copy = copyOf(world, object, name, world.poseOf(object));
  world.process().beginGesture();
  world.act(RemoveAct{object});
  world.selectLater({name});
  for (const Act& act : copy) world.act(act);
  world.process().endGesture();
  return {};
}

}  // namespace btr::ui
