#include "core/live/game.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/live/memory_json.h"
#include "core/model/joint_range.h"
#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/sim/contact/collision.h"
#include "core/sim/scene.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Positions = std::map<std::string, std::map<std::string, double>>;

Positions positionsFrom(JsonReader& reader, const std::string& key) {
  Positions positions;
  reader.members(key, [&](const std::string& robot, JsonReader joints) {
    for (const auto& [joint, value] : joints.node().items()) {
      if (!value.is_number()) joints.refuse(joint, "a position in rad or m");
      positions[robot][joint] = joints.number(joint, -1e6, 1e6);
    }
    joints.finish();
  });
  return positions;
}

GameState stateFrom(JsonReader reader) {
  GameState state;
  state.world = worldMemoryFromReader(reader.object("world"));
  constexpr long most = 1'000'000'000'000;
  state.periods = static_cast<long>(reader.integer("periods", 0, most));
  state.clocks = reader.anyValues("clocks");
  state.held = positionsFrom(reader, "held");
  state.commands = positionsFrom(reader, "commands");
  reader.array("pulls", [&](JsonReader pull) {
    state.pulls.push_back(pullFromReader(pull));
    pull.finish();
  });
  if (auto senses = reader.objectIfAny("senses")) {
    for (const auto& member : senses->node().items()) {
      const json* channels = senses->any(member.key());
      try {
        state.senses[member.key()] = channels->get<std::vector<std::vector<double>>>();
      } catch (const json::exception&) {
        senses->refuse(member.key(), "lists of numbers");
      }
    }
    senses->finish();
  }
  if (auto referee = reader.objectIfAny("referee")) state.referee = refereeStateFromReader(*referee);
  if (auto memories = reader.objectIfAny("memories")) {
    for (const auto& member : memories->node().items()) try {
        state.memories[member.key()] = memories->any(member.key())->get<std::vector<double>>();
      } catch (const json::exception&) {
        memories->refuse(member.key(), "a list of numbers");
      }
    memories->finish();
  }
  reader.members("orders", [&](const std::string& robot, JsonReader orders) {
    state.orders[robot] = ordersFromReader(orders);
    orders.finish();
  });
  reader.finish();
  return state;
}

json toJson(const GameState& state) {
  json object{
      {"world", btr::toJson(state.world)}, {"periods", state.periods}, {"clocks", state.clocks}, {"held", state.held},
      {"commands", state.commands},        {"pulls", json::array()}};
  for (const PullAct& pull : state.pulls) object["pulls"].push_back(btr::toJson(pull));
  if (!state.senses.empty()) object["senses"] = state.senses;
  if (!state.memories.empty()) object["memories"] = state.memories;
  if (state.referee) object["referee"] = btr::toJson(*state.referee);
  for (const auto& [robot, orders] : state.orders) object["orders"][robot] = btr::toJson(orders);
  return object;
}

GameStick stickFromReader(JsonReader& reader) {
  GameStick stick;
  stick.folder = reader.text("stick");
  stick.design = reader.word("design", {"ERS-7", "ERS-210", "ERS-220", ""}, "");
  stick.motorPower = reader.flag("motor_power", false);
  stick.camera = reader.flag("camera", false);
  reader.finish();
  return stick;
}

json toJson(const GameStick& stick) {
  json object{{"stick", stick.folder}};
  if (!stick.design.empty()) object["design"] = stick.design;
  if (stick.motorPower) object["motor_power"] = true;
  if (stick.camera) object["camera"] = true;
  return object;
}

/// A path that is relative stays relative, in another folder.
void moveIfRelative(std::string& path, const std::string& fromDirectory, const std::string& toDirectory) {
  if (!fs::path(path).is_relative()) return;
  const fs::path from = fs::absolute(fromDirectory.empty() ? "." : fromDirectory);
  const fs::path to = fs::absolute(toDirectory.empty() ? "." : toDirectory);
  path = (from / path).lexically_normal().lexically_relative(to.lexically_normal()).string();
}

void moveModels(SceneSpec& scene, const std::string& directory) {
  for (RobotSpec& robot : scene.robots) moveIfRelative(robot.model, scene.directory, directory);
  scene.directory = directory;
}

/// A field's floor, obstacles and balls.
void addField(SceneSpec& scene, const SceneSpec& field, const std::string& path) {
  std::set<std::string> names;
  for (const RobotSpec& robot : scene.robots) names.insert(robot.name);
  for (const BallSpec& ball : scene.balls) names.insert(ball.name);
  for (const ObstacleSpec& obstacle : scene.obstacles) names.insert(obstacle.name);
  const auto add = [&](auto& all, const auto& more) {
    for (const auto& each : more) {
      if (!names.insert(each.name).second)
        throw InputError(path, "\"" + each.name + "\"", "names that the game's scene does not have");
      all.push_back(each);
    }
  };
  add(scene.obstacles, field.obstacles);
  add(scene.balls, field.balls);
  if (field.floor) scene.floor = field.floor;
}

/// So that the lowest point of what collides just touches the floor, joints where they start.
double standingHeight(const RobotModel& model) {
  const std::vector<Eigen::Isometry3d> poses =
      forwardKinematics(model, Eigen::Isometry3d::Identity(), startPositions(model));
  double lowest = 0;
  bool any = false;
  std::vector<ContactPoint> points;
  for (std::size_t l = 0; l < model.links.size(); ++l)
    for (const Shape& shape : model.links[l].shapes) {
      if (!collidesIn(model, model.links[l], shape, "primitives")) continue;
      constexpr double anywhere = 1e6;
      floorContacts(makeCollider(shape, Eigen::Isometry3d::Identity(), 0), poses[l], anywhere, points);
      for (const ContactPoint& point : points) {
        lowest = any ? std::min(lowest, point.position_m.z()) : point.position_m.z();
        any = true;
      }
    }
  return -lowest;
}

Game gameOfRobot(const std::string& path) {
  const fs::path file(path);
  Game game;
  game.scene.directory = file.parent_path().string();
  game.scene.floor = FloorSpec{};
  game.scene.robotsCollide = true;
  game.scene.slidingFriction = SlidingFriction::isotropic;
  RobotSpec robot;
  robot.name = "robot";
  robot.model = file.filename().string();
  game.scene.robots = {robot};
  const ModelSet models = loadModels(game.scene);
  const RobotModel& model = *models.begin()->second;
  RobotSpec& placed = game.scene.robots.front();
  placed.base = model.freeBase ? "free" : "fixed";
  placed.position_m = {0, 0, standingHeight(model)};
  return game;
}

}  // namespace

PullAct pullFromReader(JsonReader& reader) {
  constexpr double farthest_m = 100;
  const auto point = [&](const std::string& key) -> std::array<double, 3> {
    const auto n = reader.numbers(key, 3, {0, 0, 0});
    for (const double each : n)
      if (std::abs(each) > farthest_m)
        reader.refuse(key, "numbers from " + toText(-farthest_m) + " to " + toText(farthest_m));
    return {n[0], n[1], n[2]};
  };
  PullAct pull;
  pull.object = reader.text("object");
  pull.link = reader.text("link", "");
  pull.point_m = point("point_m");
  pull.target_m = point("target_m");
  pull.stiffness_n_m = reader.number("stiffness_n_m", 0, 1e6, pull.stiffness_n_m);
  pull.most_n = reader.number("most_n", 0, 1e4, pull.most_n);
  return pull;
}

json toJson(const PullAct& pull) {
  return {{"object", pull.object},
          {"link", pull.link},
          {"point_m", pull.point_m},
          {"target_m", pull.target_m},
          {"stiffness_n_m", pull.stiffness_n_m},
          {"most_n", pull.most_n}};
}

void Orders::add(const Orders& later) {
  for (const auto& [joint, gain] : later.gains) gains[joint] = gain;
  for (const auto& [joint, on] : later.enabled) enabled[joint] = on;
  if (later.motorPower) motorPower = later.motorPower;
  for (const auto& [lamp, light] : later.lamps) lamps[lamp] = light;
}

Orders ordersFromReader(JsonReader& reader) {
  Orders orders;
  constexpr double mostGain = 1e6;
  if (auto gains = reader.objectIfAny("gains")) {
    for (const auto& member : gains->node().items()) {
      const std::vector<double> pid = gains->numbers(member.key(), 3);
      for (const double times : pid)
        if (!(times >= 0 && times <= mostGain)) gains->refuse(member.key(), "numbers from 0 to " + toText(mostGain));
      orders.gains[member.key()] = {pid[0], pid[1], pid[2]};
    }
    gains->finish();
  }
  if (auto enabled = reader.objectIfAny("enabled")) {
    for (const auto& member : enabled->node().items())
      orders.enabled[member.key()] = enabled->flag(member.key(), false);
    enabled->finish();
  }
  if (reader.any("motor_power")) orders.motorPower = reader.flag("motor_power", false);
  reader.members("lamps", [&](const std::string& lamp, JsonReader light) {
    orders.lamps[lamp] = {light.number("brightness", 0, 1), light.word("mode", {"A", "B", ""}, "")};
    light.finish();
  });
  return orders;
}

json toJson(const Orders& orders) {
  json object = json::object();
  if (!orders.gains.empty()) object["gains"] = orders.gains;
  if (!orders.enabled.empty()) object["enabled"] = orders.enabled;
  if (orders.motorPower) object["motor_power"] = *orders.motorPower;
  for (const auto& [name, lamp] : orders.lamps) {
    json& light = object["lamps"][name] = {{"brightness", lamp.brightness}};
    if (!lamp.mode.empty()) light["mode"] = lamp.mode;
  }
  return object;
}

GameController gameControllerFromReader(JsonReader& reader) {
  GameController controller;
  if (auto openr = reader.objectIfAny("openr")) {
    controller.openr = stickFromReader(*openr);
    reader.finish();
    return controller;
  }
  controller.plugin = reader.text("plugin");
  controller.settings = reader.anyValues("settings");
  controller.parameters = reader.anyValues("parameters");
  controller.repeats = reader.flag("repeats", true);
  reader.finish();
  return controller;
}

json toJson(const GameController& controller) {
  if (controller.openr) return {{"openr", toJson(*controller.openr)}};
  return {{"plugin", controller.plugin},
          {"settings", controller.settings},
          {"parameters", controller.parameters},
          {"repeats", controller.repeats}};
}

GameRobot gameRobotFromReader(JsonReader& reader) {
  GameRobot robot;
  robot.team = reader.word("team", {"red", "blue", ""}, "");
  if (auto controller = reader.objectIfAny("controller")) robot.controller = gameControllerFromReader(*controller);
  if (auto simulator = reader.objectIfAny("simulator")) {
    robot.simulator = simulatorFromReader(*simulator);
    simulator->finish();
  }
  if (const json* posture = reader.any("posture"); posture && posture->is_object())
    robot.stance = reader.anyValues("posture");
  else
    robot.posture = reader.flag("posture", true);
  if (const json* senses = reader.any("senses"); senses && senses->is_string())
    robot.senses = sensesOfModel(senses->get<std::string>(), reader.at("senses"));
  else
    reader.array("senses", [&](JsonReader sense) {
      robot.senses.push_back({sense.word("sense", senseNames()), {}});
      robot.senses.back().parameters = sense.values("parameters", senseParameters(robot.senses.back().sense));
      sense.finish();
    });
  reader.finish();
  return robot;
}

json toJson(const GameRobot& robot) {
  json object{{"team", robot.team}, {"posture", robot.posture}};
  if (!robot.stance.empty()) object["posture"] = robot.stance;
  if (robot.controller) object["controller"] = toJson(*robot.controller);
  if (robot.simulator) object["simulator"] = simulatorToJson(*robot.simulator);
  for (const SenseSpec& sense : robot.senses)
    object["senses"].push_back({{"sense", sense.sense}, {"parameters", sense.parameters}});
  return object;
}

Game gameFromJson(const std::string& text, const std::string& place, const std::string& directory) {
  JsonReader reader = JsonReader::parse(text, place);
  reader.word("format", {"uchilsim-game-1"});
  Game game;
  const json* scene = reader.any("scene");
  if (!scene) reader.refuse("scene", "a scene, or the path of a scene file");
  if (scene->is_string()) {
    const std::string path = (fs::path(directory) / scene->get<std::string>()).string();
    game.scene = loadScene(path);
    game.pitch = pitchFromJson(readFile(path), path);
    moveModels(game.scene, directory);
  } else {
    game.scene = sceneFromJson(scene->dump(), reader.at("scene"), directory);
    game.pitch = pitchFromJson(scene->dump(), reader.at("scene"));
  }
  if (reader.any("field")) {
    const std::string path = (fs::path(directory) / reader.text("field")).string();
    const SceneSpec field = loadScene(path);
    if (!field.robots.empty()) throw InputError(path, "a robot", "a field: floor, obstacles and balls");
    addField(game.scene, field, path);
    const PitchSpec pitch = pitchFromJson(readFile(path), path);
    if (pitch.field) game.pitch.field = pitch.field;
    if (pitch.carpet) game.pitch.carpet = pitch.carpet;
  }
  game.seed = reader.seed("seed", game.seed);
  if (auto simulator = reader.objectIfAny("simulator")) {
    game.simulator = simulatorFromReader(*simulator);
    simulator->finish();
  }
  reader.members("robots", [&](const std::string& name, JsonReader robot) {
    if (std::ranges::none_of(game.scene.robots, [&](const RobotSpec& r) { return r.name == name; }))
      reader.refuse("robots", "names of the scene's robots; it has none called \"" + name + "\"");
    game.robots[name] = gameRobotFromReader(robot);
  });
  if (auto referee = reader.objectIfAny("referee")) game.referee = refereeFromReader(*referee);
  if (auto state = reader.objectIfAny("state")) game.state = stateFrom(*state);
  if (const json* view = reader.any("view")) game.view = view->dump();
  reader.finish();
  return game;
}

std::string toJsonText(const Game& game) {
  json document{{"format", "uchilsim-game-1"},
                {"scene", json::parse(toJsonText(game.scene))},
                {"seed", game.seed},
                {"simulator", simulatorToJson(game.simulator)},
                {"robots", json::object()}};
  addTo(document["scene"], game.pitch);
  for (const auto& [name, robot] : game.robots) document["robots"][name] = toJson(robot);
  if (game.referee) document["referee"] = toJson(*game.referee);
  if (game.state) document["state"] = toJson(*game.state);
  if (!game.view.empty()) document["view"] = json::parse(game.view);
  return document.dump(1) + "\n";
}

Game movedTo(Game game, const std::string& directory) {
  for (auto& robot : game.robots)
    if (robot.second.hasStick())
      moveIfRelative(robot.second.controller->openr->folder, game.scene.directory, directory);
  moveModels(game.scene, directory);
  return game;
}

Game loadGame(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".wrl" || ending == ".urdf" || ending == ".xacro") return gameOfRobot(path);
  const std::string text = readFile(path), directory = fs::path(path).parent_path().string();
  JsonReader reader = JsonReader::parse(text, path);
  const std::string format = reader.word("format", {"uchilsim-game-1", "uchilsim-scene-1"});
  if (format == "uchilsim-game-1") return gameFromJson(text, path, directory);
  Game game;
  game.scene = sceneFromJson(text, path, directory);
  game.pitch = pitchFromJson(text, path);
  return game;
}

}  // namespace btr
