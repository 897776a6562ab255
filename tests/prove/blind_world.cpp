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

void calibrate(BlindWorld& world, const std::string& path, double trueValue) {
  world.truth[path] = trueValue;
  const double low = 0.4 * std::abs(trueValue), high = 2.5 * std::abs(trueValue);
  world.scene.calibrate.push_back({path, trueValue < 0 ? -high : low, trueValue < 0 ? -low : high});
}

void addColumn(BlindWorld& world, MeasuredColumn::What what, std::size_t part, const std::string& name, double noise,
               double quantum) {
  world.columns.push_back({what, part, name, noise, quantum});
}

}  // namespace btr::prove
