#include "ui/live/drawn/live_lines.h"

#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"

namespace btr::ui {

using nlohmann::json;

namespace {

/// "goal of red", "half time".
QString eventText(const json& event) {
  if (!event.is_object()) return QString::fromStdString(event.is_string() ? event.get<std::string>() : event.dump());
  const QString what = QString::fromStdString(event.value("what", "")).replace('_', ' ');
  const QString team = QString::fromStdString(event.value("team", ""));
  return team.isEmpty() ? what : QObject::tr("%1 of %2").arg(what, team);
}

QString textAt(const json& list, std::size_t at) { return QString::fromStdString(list.at(at).get<std::string>()); }

}  // namespace

ToldGame toldGameFrom(const json& line) {
  return {gameFromJson(line.at("game").dump(), "game", line.at("directory").get<std::string>()),
          line.at("channels").get<std::vector<std::string>>()};
}

LiveRow liveRowFrom(const json& line) {
  LiveRow row;
  row.values = line.at("row").get<std::vector<double>>();
  row.period = line.at("period").get<long>();
  row.playing = line.at("playing").get<bool>();
  row.realTimeFactor = line.at("real_time_factor").get<double>();
  for (const json& each : line.at("fixed")) {
    const auto n = each.get<std::vector<double>>();
    row.fixed.emplace_back(
        static_cast<std::size_t>(n.at(0)),
        Eigen::Translation3d(n.at(1), n.at(2), n.at(3)) * Eigen::Quaterniond(n.at(4), n.at(5), n.at(6), n.at(7)));
  }
  row.fault = QString::fromStdString(line.value("fault", ""));
  if (line.contains("score")) row.score = line.at("score").get<std::array<int, 2>>();
  if (line.contains("hands_n"))
    for (const auto& [object, force] : line.at("hands_n").items()) {
      const auto f = force.get<std::array<double, 3>>();
      row.hands_n[object] = {f[0], f[1], f[2]};
    }
  row.clock_s = line.value("clock_s", 0.0);
  if (line.contains("events"))
    for (const json& event : line.at("events")) row.events << eventText(event);
  if (line.contains("orders"))
    for (const auto& [robot, orders] : line.at("orders").items()) {
      JsonReader reader = JsonReader::parse(orders.dump(), "orders");
      row.orders[robot] = ordersFromReader(reader);
    }
  if (line.contains("console"))
    for (const json& said : line.at("console"))
      row.console.push_back({textAt(said, 0), textAt(said, 1), textAt(said, 2)});
  if (line.contains("programs")) {
    row.programs.emplace();
    for (const auto& [robot, state] : line.at("programs").items())
      (*row.programs)[robot] =
          state.at("running").get<bool>() ? QString() : QString::fromStdString(state.at("what").get<std::string>());
  }
  if (const auto replay = line.find("replay"); replay != line.end()) {
    row.replay.emplace();
    row.replay->sameUntil = replay->at("same_until").get<long>();
    row.replay->over = replay->at("over").get<bool>();
    if (replay->contains("differs_by")) row.replay->differsBy = replay->at("differs_by").get<long>();
  }
  if (line.contains("contacts"))
    for (const json& contact : line.at("contacts")) {
      const auto n = contact.get<std::array<double, 6>>();
      row.contacts.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    }
  return row;
}

}  // namespace btr::ui
