#include "ui/scene3d/ball_roll.h"

#include <Eigen/Geometry>
#include <cmath>

namespace btr::ui {

void appendRoll(Trace& trace, const std::string& name, double radius_m, const Eigen::Vector3d& rest_m) {
  constexpr double shortest_m = 0.005, longest_s = 20;
  const int time = trace.column("time_s"), x = trace.column(name + ".x_m"), y = trace.column(name + ".y_m");
  const std::size_t width = trace.channels.size(), rows = trace.rows();
  if (time < 0 || x < 0 || y < 0 || rows < 2) return;
  const auto at = [&](std::size_t row, int column) { return trace.at(row, static_cast<std::size_t>(column)); };
  const Eigen::Vector2d last(at(rows - 1, x), at(rows - 1, y)), before(at(rows - 2, x), at(rows - 2, y));
  const double period = at(rows - 1, time) - at(rows - 2, time);
  const Eigen::Vector2d way = rest_m.head<2>() - last;
  const double length = way.norm(), speed = (last - before).norm() / period;
  if (length < shortest_m || !(speed > 0) || (last - before).dot(way) <= 0) return;
  // v²/(2a) = length, v/a = duration
  const double duration = 2 * length / speed;
  if (!(duration < longest_s)) return;

  int turn[4];
  const char* parts[] = {".qw", ".qx", ".qy", ".qz"};
  for (int i = 0; i < 4; ++i) turn[i] = trace.column(name + parts[i]);
  const bool turns = turn[0] >= 0 && turn[1] >= 0 && turn[2] >= 0 && turn[3] >= 0 && radius_m > 0;
  const Eigen::Vector2d along = way / length;
  const Eigen::Vector3d axis(-along.y(), along.x(), 0);
  Eigen::Quaterniond start = Eigen::Quaterniond::Identity();
  if (turns) start = {at(rows - 1, turn[0]), at(rows - 1, turn[1]), at(rows - 1, turn[2]), at(rows - 1, turn[3])};

  const std::vector<double> held(trace.values.end() - static_cast<std::ptrdiff_t>(width), trace.values.end());
  const auto more = static_cast<std::size_t>(std::ceil(duration / period));
  for (std::size_t i = 1; i <= more; ++i) {
    const double t = std::min(static_cast<double>(i) * period, duration);
    const double gone = speed * t - speed * speed / (4 * length) * t * t;
    std::vector<double> row = held;
    row[static_cast<std::size_t>(time)] += static_cast<double>(i) * period;
    row[static_cast<std::size_t>(x)] += gone * along.x();
    row[static_cast<std::size_t>(y)] += gone * along.y();
    if (turns) {
      const Eigen::Quaterniond now = Eigen::AngleAxisd(gone / radius_m, axis) * start;
      const double parts4[] = {now.w(), now.x(), now.y(), now.z()};
      for (int k = 0; k < 4; ++k) row[static_cast<std::size_t>(turn[k])] = parts4[k];
    }
    trace.values.insert(trace.values.end(), row.begin(), row.end());
  }
}

}  // namespace btr::ui
