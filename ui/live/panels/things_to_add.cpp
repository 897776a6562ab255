#include "ui/live/panels/things_to_add.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QRegularExpression>
#include <cmath>
#include <filesystem>

#include "ui/common/resources.h"
#include "ui/live/free_place.h"
#include "ui/live/live_world.h"

namespace btr::ui {
namespace {

QString thingText(const char* text) { return QCoreApplication::translate("ThingToAdd", text); }

ObstacleSpec obstacleOf(const std::string& shape, std::array<double, 3> size_m, double mass_kg) {
  ObstacleSpec spec;
  spec.shape = shape;
  spec.size_m = size_m;
  spec.mass_kg = mass_kg;
  return spec;
}

}  // namespace

ThingToAdd robotToAdd(const QString& file) {
  const QString base = QFileInfo(file).completeBaseName();
  return {QString(base).replace(QRegularExpression("[^A-Za-z0-9_-]"), "_").toStdString(), base, file};
}

std::vector<ThingToAdd> thingsToAdd() {
  BallSpec ball;
  ball.rollingDeceleration_m_s2 = 0.4;
  ball.restitution = 0.4;
  std::vector<ThingToAdd> things{
      {"ball", thingText("Ball"), ball},
      {"box", thingText("Box that can be pushed"), obstacleOf("box", {0.1, 0.1, 0.1}, 0.2)},
      {"cylinder", thingText("Cylinder that can be pushed"), obstacleOf("cylinder", {0.1, 0.1, 0.2}, 0.3)},
      {"ramp", thingText("Ramp"), obstacleOf("ramp", {0.5, 0.4, 0.1}, 0)},
      {"wall", thingText("Wall"), obstacleOf("box", {0.05, 0.6, 0.2}, 0)}};
  for (const char* robot : {"ers7", "ers210", "ers220"}) {
    ThingToAdd thing = robotToAdd(resourceDirectory() + "/robots/" + robot + ".wrl");
    thing.text = QString("AIBO %1").arg(QString(robot).toUpper().insert(3, '-'));
    things.push_back(std::move(thing));
  }
  return things;
}

void addThing(LiveWorld& world, const ThingToAdd& thing, const Eigen::Vector2d& wished) {
  AddAct act;
  const std::string name = world.freeName(thing.word);
  const std::vector<Footprint> taken = footprintsOf(world);
  if (const auto* ball = std::get_if<BallSpec>(&thing.what)) {
    BallSpec spec = *ball;
    const Eigen::Vector2d at = freePlace(taken, wished, spec.radius_m);
    spec.name = name;
    spec.position_m = {at.x(), at.y(), spec.radius_m};
    act.what = spec;
  } else if (const auto* obstacle = std::get_if<ObstacleSpec>(&thing.what)) {
    ObstacleSpec spec = *obstacle;
    const bool round = spec.shape == "cylinder" || spec.shape == "sphere";
    const double radius = round ? spec.radius_m : std::hypot(spec.size_m[0], spec.size_m[1]) / 2;
    const Eigen::Vector2d at = freePlace(taken, wished, radius);
    spec.name = name;
    spec.position_m = {at.x(), at.y(), spec.shape == "sphere" ? spec.radius_m : spec.size_m[2] / 2};
    act.what = spec;
  } else {
    const std::string file = std::get<QString>(thing.what).toStdString();
    RobotSpec spec = loadGame(file).scene.robots.at(0);
    const Eigen::Vector2d at = freePlace(taken, wished, dogRadius_m);
    spec.name = name;
    spec.model = std::filesystem::absolute(file).string();
    spec.position_m[0] = at.x();
    spec.position_m[1] = at.y();
    act.what = spec;
  }
  world.selectLater({name});
  world.act(act);
}

}  // namespace btr::ui
