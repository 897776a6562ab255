#include "tests/prove/blind_world.h"

#include <cmath>

#include "core/spec/error.h"

namespace btr::prove {

double MeasuredColumn::floor() const { return std::sqrt(noise * noise + quantum * quantum / 12); }

const std::vector<std::string>& sceneKinds() {
  static const std::vector<std::string> kinds{"pendulum", "leg", "carpet", "flight", "walk"};
  return kinds;
}

BlindWorld drawWorld(const std::string& kind, Random& random) {
  if (kind == "pendulum") return drawPendulum(random);
  if (kind == "leg") return drawLeg(random);
  if (kind == "carpet") return drawCarpet(random);
  if (kind == "flight") return drawFlight(random);
  if (kind == "walk") return drawWalk(random);
  throw InputError("--scene", kind, "pendulum, leg, carpet, flight or walk");
}

double drawLog(Random& random, double low, double high) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

double mostError(const std::string& path) { return path == "gravity_m_s2.z" ? 0.05 : 0.2; }

void calibrate(BlindWorld& world, Random& random, const std::string& path, double given) {
  world.given[path] = given;
  const double low = drawLog(random, 0.3, 0.6) * std::abs(given), high = drawLog(random, 1.7, 3.4) * std::abs(given);
  world.scene.calibrate.push_back({path, given < 0 ? -high : low, given < 0 ? -low : high});
}

Sensor drawSensor(Random& random, double low, double high, double roundsToo, double coarsest) {
  constexpr double exact = 1.0 / 6;
  const double noise = drawLog(random, low, high);
  const double quantum = random.chance(roundsToo) ? noise * random.uniform(0.3, coarsest) : 0;
  // The standard deviation of rounding is its step over √12.
  return random.chance(exact) ? Sensor{0, noise * std::sqrt(12)} : Sensor{noise, quantum};
}

void addColumn(BlindWorld& world, MeasuredColumn::What what, std::size_t part, const std::string& name,
               const Sensor& sensor) {
  world.columns.push_back({what, part, name, sensor.noise, sensor.quantum});
}

void keepBack(BlindWorld& world, std::size_t count) {
  const auto from = world.trials.end() - static_cast<std::ptrdiff_t>(count);
  world.fresh.assign(from, world.trials.end());
  world.trials.erase(from, world.trials.end());
}

}  // namespace btr::prove
