#include "core/live/act.h"

#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

using nlohmann::json;

constexpr double farthest_m = 100, fastest_m_s = 50, fastestSpin_rad_s = 500;

template <std::size_t N>
std::array<double, N> arrayOf(JsonReader& reader, const std::string& key, double largest,
                              std::array<double, N> byDefault) {
  const auto numbers = reader.numbers(key, N, {byDefault.begin(), byDefault.end()});
  std::array<double, N> array{};
  for (std::size_t i = 0; i < N; ++i) {
    if (!(numbers[i] >= -largest && numbers[i] <= largest))
      reader.refuse(key, "numbers from " + toText(-largest) + " to " + toText(largest));
    array[i] = numbers[i];
  }
  return array;
}

std::array<double, 4> orientationOf(JsonReader& reader) {
  auto q = arrayOf<4>(reader, "orientation_wxyz", 1.01, {1, 0, 0, 0});
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(square > 0.98 && square < 1.02)) reader.refuse("orientation_wxyz", "a unit quaternion w, x, y, z");
  return q;
}

std::string specText(JsonReader& reader, const std::string& key) { return reader.any(key)->dump(); }

Act addFrom(JsonReader& reader) {
  AddAct act;
  const bool robot = reader.has("robot"), ball = reader.has("ball"), obstacle = reader.has("obstacle");
  if (robot + ball + obstacle != 1)
    throw InputError(reader.place() + ": \"add\" needs one of robot, ball and obstacle, and only one");
  if (robot) act.what = robotFromJson(specText(reader, "robot"), reader.at("robot"));
  if (ball) act.what = ballFromJson(specText(reader, "ball"), reader.at("ball"));
  if (obstacle) act.what = obstacleFromJson(specText(reader, "obstacle"), reader.at("obstacle"));
  if (auto player = reader.objectIfAny("player")) {
    if (!robot) reader.refuse("player", "a player for a robot only");
    act.player = gameRobotFromReader(*player);
  }
  constexpr long mostObjects = 100000;
  if (reader.any("index")) act.index = static_cast<std::size_t>(reader.integer("index", 0, mostObjects));
  return act;
}

Act effectFrom(JsonReader& reader) {
  EffectAct act;
  act.robot = reader.text("robot", "");
  act.effect.effect = reader.text("effect");
  act.effect.at = reader.text("at");
  act.effect.parameters = reader.anyValues("parameters");
  act.there = reader.flag("there", true);
  return act;
}

Act actFrom(JsonReader& reader, const std::string& kind) {
  const auto optionalNumber = [&](const std::string& key) -> std::optional<double> {
    if (!reader.any(key)) return std::nullopt;
    return reader.number(key, -1e12, 1e12);
  };
  if (kind == "place")
    return PlaceAct{reader.text("object"), arrayOf<3>(reader, "position_m", farthest_m, {}), orientationOf(reader),
                    reader.anyValues("joints"), reader.anyValues("commands")};
  if (kind == "throw")
    return ThrowAct{reader.text("object"), arrayOf<3>(reader, "velocity_m_s", fastest_m_s, {}),
                    arrayOf<3>(reader, "spin_rad_s", fastestSpin_rad_s, {})};
  if (kind == "add") return addFrom(reader);
  if (kind == "remove") return RemoveAct{reader.text("object")};
  if (kind == "pull") return pullFromReader(reader);
  if (kind == "let_go") return LetGoAct{reader.text("object")};
  if (kind == "hold")
    return HoldAct{reader.text("robot"), reader.text("joint"), optionalNumber("position"), optionalNumber("command")};
  if (kind == "parameter") return ParameterAct{reader.text("robot"), reader.text("name"), optionalNumber("value")};
  if (kind == "controller") {
    ControllerAct act{reader.text("robot"), std::nullopt};
    if (auto controller = reader.objectIfAny("controller")) act.controller = gameControllerFromReader(*controller);
    act.commands = reader.anyValues("commands");
    return act;
  }
  if (kind == "orders") {
    OrdersAct act{reader.text("robot"), reader.anyValues("targets")};
    act.orders = ordersFromReader(reader);
    return act;
  }
  if (kind == "number") return NumberAct{reader.text("robot", ""), reader.text("name"), optionalNumber("value")};
  if (kind == "effect") return effectFrom(reader);
  if (kind == "simulator") {
    SimulatorAct act{reader.text("robot", ""), std::nullopt};
    if (auto simulator = reader.objectIfAny("simulator")) {
      act.simulator = simulatorFromReader(*simulator);
      simulator->finish();
    }
    return act;
  }
  if (kind == "kick_off") return KickOffAct{reader.word("team", {"red", "blue", ""}, "")};
  if (kind == "score") {
    constexpr int most = 1'000'000;
    return ScoreAct{static_cast<int>(reader.integer("red", 0, most)),
                    static_cast<int>(reader.integer("blue", 0, most))};
  }
  return CheckpointAct{};
}

json written(const PlaceAct& act) {
  json object{{"act", "place"},
              {"object", act.object},
              {"position_m", act.position_m},
              {"orientation_wxyz", act.orientation_wxyz},
              {"joints", act.joints}};
  if (!act.commands.empty()) object["commands"] = act.commands;
  return object;
}
json written(const ThrowAct& act) {
  return {{"act", "throw"}, {"object", act.object}, {"velocity_m_s", act.velocity_m_s}, {"spin_rad_s", act.spin_rad_s}};
}
json written(const AddAct& act) {
  json object{{"act", "add"}};
  if (const auto* robot = std::get_if<RobotSpec>(&act.what)) {
    object["robot"] = json::parse(toJsonText(*robot));
    object["player"] = btr::toJson(act.player);
  } else if (const auto* ball = std::get_if<BallSpec>(&act.what)) {
    object["ball"] = json::parse(toJsonText(*ball));
  } else {
    object["obstacle"] = json::parse(toJsonText(std::get<ObstacleSpec>(act.what)));
  }
  if (act.index) object["index"] = *act.index;
  return object;
}
json written(const RemoveAct& act) { return {{"act", "remove"}, {"object", act.object}}; }
json written(const PullAct& act) {
  json object = btr::toJson(act);
  object["act"] = "pull";
  return object;
}
json written(const LetGoAct& act) { return {{"act", "let_go"}, {"object", act.object}}; }
json written(const HoldAct& act) {
  json object{{"act", "hold"}, {"robot", act.robot}, {"joint", act.joint}};
  if (act.position) object["position"] = *act.position;
  if (act.command) object["command"] = *act.command;
  return object;
}
json written(const ParameterAct& act) {
  json object{{"act", "parameter"}, {"robot", act.robot}, {"name", act.name}};
  if (act.value) object["value"] = *act.value;
  return object;
}
json written(const ControllerAct& act) {
  json object{{"act", "controller"}, {"robot", act.robot}};
  if (act.controller) object["controller"] = btr::toJson(*act.controller);
  if (!act.commands.empty()) object["commands"] = act.commands;
  return object;
}
json written(const OrdersAct& act) {
  json object = btr::toJson(act.orders);
  object["act"] = "orders";
  object["robot"] = act.robot;
  if (!act.targets.empty()) object["targets"] = act.targets;
  return object;
}
json written(const NumberAct& act) {
  json object{{"act", "number"}, {"robot", act.robot}, {"name", act.name}};
  if (act.value) object["value"] = *act.value;
  return object;
}
json written(const EffectAct& act) {
  return {{"act", "effect"},
          {"robot", act.robot},
          {"effect", act.effect.effect},
          {"at", act.effect.at},
          {"parameters", act.effect.parameters},
          {"there", act.there}};
}
json written(const SimulatorAct& act) {
  json object{{"act", "simulator"}, {"robot", act.robot}};
  if (act.simulator) object["simulator"] = simulatorToJson(*act.simulator);
  return object;
}
json written(const KickOffAct& act) {
  json object{{"act", "kick_off"}};
  if (!act.team.empty()) object["team"] = act.team;
  return object;
}
json written(const ScoreAct& act) { return {{"act", "score"}, {"red", act.red}, {"blue", act.blue}}; }
json written(const CheckpointAct&) { return {{"act", "checkpoint"}}; }

}  // namespace

Act actFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  const std::string kind =
      reader.word("act", {"place", "throw", "add", "remove", "pull", "let_go", "hold", "parameter", "controller",
                          "orders", "number", "effect", "simulator", "kick_off", "score", "checkpoint"});
  Act act = actFrom(reader, kind);
  reader.finish();
  return act;
}

json toJson(const Act& act) {
  return std::visit([](const auto& each) { return written(each); }, act);
}

}  // namespace btr
