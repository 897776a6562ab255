#include "app/live/btr_live_lines.h"

#include <nlohmann/json.hpp>

namespace btr::cli {
namespace {

using nlohmann::json;

/// Obstacles that never move have no columns in a trace: number and pose.
json fixedObstacles(const Session& session) {
  json fixed = json::array();
  for (std::size_t i = 0; i < session.game().scene.obstacles.size(); ++i) {
    if (session.game().scene.obstacles[i].mass_kg > 0) continue;
    const ObstacleState& state = session.world().obstacle(i);
    const Eigen::Quaterniond q(state.pose.linear());
    const Eigen::Vector3d p = state.pose.translation();
    fixed.push_back({i, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
  }
  return fixed;
}

/// Of the hands that pull, by object [N], world axes.
json handForces(const Session& session) {
  json forces = json::object();
  const auto add = [&](const auto& specs) {
    for (const auto& spec : specs)
      if (const Eigen::Vector3d f = session.handForce_n(spec.name); !f.isZero())
        forces[spec.name] = {f.x(), f.y(), f.z()};
  };
  add(session.game().scene.robots);
  add(session.game().scene.balls);
  add(session.game().scene.obstacles);
  return forces;
}

/// Place [m] and force [N], world.
json contacts(const Session& session) {
  json all = json::array();
  for (const ContactForce& contact : session.world().contactForces()) {
    const auto& [p, f] = contact;
    all.push_back({p.x(), p.y(), p.z(), f.x(), f.y(), f.z()});
  }
  return all;
}

/// What can be seen of what programs ordered, by robot.
json lamps(const Session& session) {
  json all = json::object();
  for (const auto& [robot, orders] : session.orders()) {
    Orders seen;
    seen.motorPower = orders.motorPower.value_or(false);
    seen.lamps = orders.lamps;
    all[robot] = toJson(seen);
  }
  for (const auto& [robot, lit] : session.lamps()) {
    if (lit.empty()) continue;
    Orders seen;
    seen.motorPower = true;
    for (const auto& [lamp, brightness] : lit) seen.lamps[lamp] = {brightness};
    all[robot] = toJson(seen);
  }
  return all;
}

}  // namespace

json gameLine(const Session& session) {
  json line{{"game", json::parse(toJsonText(session.game()))},
            {"directory", session.game().scene.directory},
            {"channels", session.channels()},
            {"pulls", json::array()},
            {"held", session.held()}};
  for (const auto& [object, pull] : session.pulls()) line["pulls"].push_back(toJson(pull));
  return line;
}

std::vector<std::string> overlapsIn(const Session& session) {
  constexpr double deep_m = 0.01;  // paws press in less
  std::vector<std::string> texts;
  for (const Overlap& overlap : session.world().overlaps(deep_m)) texts.push_back(overlap.text());
  return texts;
}

json rowLine(const Session& session, bool playing, double realTimeFactor) {
  std::vector<double> row;
  session.sample(row);
  json line{{"row", row},
            {"period", session.periods()},
            {"playing", playing},
            {"real_time_factor", realTimeFactor},
            {"fixed", fixedObstacles(session)}};
  if (json hands = handForces(session); !hands.empty()) line["hands_n"] = std::move(hands);
  if (session.measuresContacts()) line["contacts"] = contacts(session);
  if (json orders = lamps(session); !orders.empty()) line["orders"] = std::move(orders);
  if (!session.fault().empty()) line["fault"] = session.fault();
  return line;
}

}  // namespace btr::cli
