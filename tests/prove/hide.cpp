#include "tests/prove/hide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/prove/removal.h"

namespace btr::prove {
namespace {

constexpr double mostOfRoom = 0.7;  // between neutral and a bound

std::vector<std::string> placesOf(Effect::Place place, const BlindWorld& world) {
  std::vector<std::string> places;
  const SceneSpec& scene = world.scene;
  for (const RobotSpec& robot : scene.robots) {
    const RobotModel& model = *world.models.at(robot.model);
    if (place == Effect::Place::joint)
      for (const std::size_t joint : world.commanded) places.push_back(robot.name + "." + model.joints[joint].name);
    // Parts that weigh something; the stand of a rig does not move.
    constexpr double lightest_kg = 0.03;
    for (std::size_t link = robot.base == "fixed" ? 1 : 0; link < model.links.size(); ++link)
      if (place == Effect::Place::link && model.links[link].inertial.mass_kg >= lightest_kg)
        places.push_back(robot.name + "." + model.links[link].name);
  }
  if (place == Effect::Place::ball)
    for (const BallSpec& ball : scene.balls) places.push_back(ball.name);
  if (place == Effect::Place::floor && scene.floor) places.push_back("floor");
  if (place == Effect::Place::world) places.push_back("world");
  return places;
}

double drawShape(Random& random, const Parameter& parameter) {
  // Which of a few ways to build it.
  constexpr double fewWays = 5;
  if (const double ways = parameter.maximum - parameter.minimum + 1; parameter.integer && ways <= fewWays)
    return parameter.minimum + static_cast<double>(random.below(static_cast<std::size_t>(ways)));
  const double by = parameter.byDefault;
  const double drawn = by > 0 && parameter.minimum >= 0
                           ? drawLog(random, by / 2, by * 2)
                           : by + 0.15 * (parameter.maximum - parameter.minimum) * random.uniform(-1, 1);
  const double within = std::clamp(drawn, parameter.minimum, parameter.maximum);
  return parameter.integer ? std::round(within) : within;
}

/// What a size usually is, away from neutral.
double typicalOf(const Parameter& size) {
  const double usual = std::abs(size.byDefault - *size.neutral);
  return usual > 0 ? usual : 0.1 * (size.maximum - size.minimum);
}

/// Directions in which the sizes grow from neutral: in what they usually are, signed.
std::map<std::string, double> drawDirection(Random& random, const std::vector<Parameter>& parameters) {
  std::map<std::string, double> direction;
  std::size_t sizes = 0, signedSizes = 0;
  for (const Parameter& parameter : parameters)
    if (parameter.neutral) {
      ++sizes;
      if (*parameter.neutral > parameter.minimum) ++signedSizes;
    }
  // Of several that may have either sign (the axes of a tilt) some stay away.
  const bool sparse = signedSizes > 1 && signedSizes == sizes && random.chance(0.5);
  const std::size_t kept = sparse ? random.below(sizes) : 0;
  std::size_t number = 0;
  for (const Parameter& parameter : parameters) {
    if (!parameter.neutral) continue;
    const bool both = *parameter.neutral > parameter.minimum && *parameter.neutral < parameter.maximum;
    const double sign = both ? (random.chance(0.5) ? 1 : -1) : *parameter.neutral > parameter.minimum ? -1 : 1;
    const double share = random.uniform(0.4, 1);
    if (!sparse || number == kept) direction[parameter.name] = sign * share;
    ++number;
  }
  return direction;
}

void setSize(PlacedEffect& placed, const std::vector<Parameter>& parameters,
             const std::map<std::string, double>& direction, double scale) {
  for (const Parameter& parameter : parameters) {
    if (!parameter.neutral) continue;
    const double neutral = *parameter.neutral;
    const auto found = direction.find(parameter.name);
    const double way = found == direction.end() ? 0 : found->second;
    const double room = way < 0 ? neutral - parameter.minimum : parameter.maximum - neutral;
    const double most = mostOfRoom * room;
    placed.parameters[parameter.name] = neutral + std::clamp(scale * way * typicalOf(parameter), -most, most);
  }
}

/// Where the fits of a simpler relative begin: at its usual size and where it comes nearest among sizes from a
/// hundredth to ten thousand times that, and as large as is allowed (what holds a joint is any friction above what its
/// motor can).
std::vector<SimulatorSpec> simplerStarts(const Effect& effect, PlacedEffect relative, const BlindWorld& world,
                                         const SimulatorSpec& without, const EffectFactory& effects,
                                         const std::vector<std::vector<double>>& recorded) {
  constexpr std::array<double, 14> shares{1, 0.01, 0.03, 0.1, 0.3, 3, 10, 30, 100, 300, 1000, 3000, 10000, 1e9};
  constexpr std::size_t nearest = 3;
  std::vector<std::pair<double, SimulatorSpec>> starts;
  for (const double share : shares) {
    for (const Parameter& parameter : effect.parameters())
      relative.parameters[parameter.name] =
          std::clamp(parameter.byDefault * (parameter.neutral ? share : 1), parameter.minimum, parameter.maximum);
    SimulatorSpec other = without;
    other.effects.push_back(relative);
    const double off = difference(noiseless(world, other, effects), recorded);
    if (std::isfinite(off)) starts.emplace_back(off, std::move(other));
  }
  if (starts.size() > 1)
    std::stable_sort(starts.begin() + 1, starts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SimulatorSpec> chosen;
  for (std::size_t i = 0; i < std::min(1 + nearest, starts.size()); ++i) chosen.push_back(starts[i].second);
  return chosen;
}

/// A wind without the drag of still air is no physics where a ball is fast enough to feel that: it is hidden beside it.
bool waitsForAnother(const Effect& effect, const BlindWorld& world, const SimulatorSpec& before,
                     const std::vector<std::string>& names, const EffectFactory& effects) {
  constexpr double felt = 2;  // noise floors, as what is hidden at least
  const std::vector<std::string> needs = effect.needs();
  const auto isNeeded = [&](const std::string& name) { return std::ranges::count(needs, name) > 0; };
  if (std::ranges::any_of(before.effects, isNeeded, &PlacedEffect::effect)) return false;
  for (const std::string& name : names) {
    if (!isNeeded(name)) continue;
    const auto other = effects(name);
    for (const std::string& at : placesOf(other->place(), world)) {
      SimulatorSpec with = before;
      with.effects.push_back({name, at, {}});
      for (const Parameter& parameter : other->parameters())
        with.effects.back().parameters[parameter.name] = parameter.byDefault;
      if (difference(noiseless(world, with, effects), noiseless(world, before, effects)) >= felt) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<PlacedEffect> drawHidden(Random& random, const BlindWorld& world, const SimulatorSpec& before,
                                       const std::vector<std::string>& names, const EffectFactory& effects) {
  PlacedEffect placed;
  placed.effect = names[random.below(names.size())];
  const auto effect = effects(placed.effect);
  // On a floor a turned gravity is the same as a sloping floor: that name is the one used there.
  if (placed.effect == "gravity_tilt" && world.scene.floor) return std::nullopt;
  const auto places = placesOf(effect->place(), world);
  if (places.empty()) return std::nullopt;
  placed.at = places[random.below(places.size())];
  for (const PlacedEffect& other : before.effects)
    if (other.effect == placed.effect) return std::nullopt;

  if (waitsForAnother(*effect, world, before, names, effects)) return std::nullopt;

  const auto parameters = effect->parameters();
  for (const Parameter& parameter : parameters)
    // Details stay as they are by default: not every engine that blind trials run in has them.
    if (!parameter.neutral && !parameter.refines) placed.parameters[parameter.name] = drawShape(random, parameter);
  const auto direction = drawDirection(random, parameters);
  if (direction.empty()) return std::nullopt;
  const double wanted = drawLog(random, 2, 100);

  const auto without = noiseless(world, before, effects);
  const auto moved = [&](double scale) {
    SimulatorSpec with = before;
    setSize(placed, parameters, direction, scale);
    with.effects.push_back(placed);
    return difference(noiseless(world, with, effects), without);
  };
  // Bisection of the size's logarithm. What breaks the simulation is too large. Where even the largest size moves less
  // than wanted (a joint that is held cannot be held more), hardly larger than it takes for that.
  double room = 1;
  for (const Parameter& p : parameters)
    if (p.neutral) room = std::max(room, (p.maximum - p.minimum) / typicalOf(p));
  double low = std::log(1e-3), high = std::log(room);
  const double most = moved(std::exp(high));
  if (most < 2) return std::nullopt;
  constexpr double nearlyMost = 0.99;
  const double target = most <= wanted ? nearlyMost * most : wanted;
  for (int i = 0; i < 9; ++i) {
    const double middle = (low + high) / 2;
    (moved(std::exp(middle)) < target ? low : high) = middle;
  }
  const double got = moved(std::exp(low));
  if (!(got >= 1)) return std::nullopt;
  return placed;
}

ConcealedAnswer::Hidden describeHidden(const PlacedEffect& placed, const BlindWorld& world,
                                       const EffectFactory& effects) {
  ConcealedAnswer::Hidden hidden;
  hidden.placed = placed;
  hidden.outside = placed.effect.rfind("outside_", 0) == 0;
  for (const RobotSpec& robot : world.scene.robots) {
    const RobotModel& model = *world.models.at(robot.model);
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const std::string joint = robot.name + "." + model.joints[j].name,
                        link = robot.name + "." + model.links[j + 1].name;
      if (placed.at == joint) hidden.alsoAt = link;
      if (placed.at == link) hidden.alsoAt = joint;
    }
  }
  for (const Parameter& parameter : effects(placed.effect)->parameters())
    if (parameter.neutral && placed.parameters.at(parameter.name) != *parameter.neutral)
      hidden.sizes.push_back(parameter.name);
  return hidden;
}

void priceRemoval(ConcealedAnswer::Hidden& hidden, std::size_t index, const BlindWorld& world,
                  const SimulatorSpec& simulator, const Hideable& library, const EffectFactory& effects) {
  const auto recorded = noiseless(world, simulator, effects);
  const auto withNoise = [](double left) { return std::min(1e6, std::sqrt(1 + left * left)); };
  SimulatorSpec without = simulator;
  without.effects.erase(without.effects.begin() + static_cast<std::ptrdiff_t>(index));
  const double unfitted = difference(noiseless(world, without, effects), recorded);
  hidden.costUnfitted = std::isfinite(unfitted) ? withNoise(unfitted) : 1e6;
  double left = leftAfterRefit(world, without, effects, recorded);

  for (const std::string& name : effects(hidden.placed.effect)->contains()) {
    if (std::find(library.names.begin(), library.names.end(), name) == library.names.end()) continue;
    const auto starts = simplerStarts(*effects(name), {name, hidden.placed.at, {}}, world, without, effects, recorded);
    for (const SimulatorSpec& other : starts) {
      if (withNoise(left) < leastCost) break;
      const int whole = static_cast<int>(other.effects.size()) - 1;
      left = std::min(left, leftAfterRefit(world, other, effects, recorded, whole));
    }
  }
  hidden.cost = withNoise(left);
}

}  // namespace btr::prove
