#include "ui/live/live_lines.h"

#include <nlohmann/json.hpp>

namespace btr::ui {

using nlohmann::json;

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
  return row;
}

}  // namespace btr::ui
