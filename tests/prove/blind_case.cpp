#include "tests/prove/blind_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/spec/error.h"
#include "tests/prove/hide.h"
#include "tests/prove/outside_effects.h"
#include "tests/prove/reality.h"

namespace btr::prove {
namespace {

std::string drawScene(Random& random, const std::string& engine) {
  const double u = random.uniform();
  if (engine == "mujoco") return u < 0.4 ? "pendulum" : u < 0.75 ? "leg" : "walk";
  return u < 0.32 ? "pendulum" : u < 0.52 ? "leg" : u < 0.72 ? "carpet" : u < 0.87 ? "flight" : "walk";
}

/// Half of all cases have nothing to be found.
std::string drawKind(Random& random) {
  const double u = random.uniform();
  return u < 0.25 ? "nothing" : u < 0.5 ? "parameters" : u < 0.8 ? "one" : u < 0.9 ? "two" : "outside";
}

/// What is true of the numbers that the scene's author gave. The truth is drawn around what is given, not the other way
/// round: so what is given has the same distribution whether it is right or wrong.
Values drawTruth(const BlindWorld& world, const std::string& kind, Random random) {
  const bool sometimes = random.chance(0.7);
  const bool wrong = kind == "parameters" || (kind != "nothing" && sometimes);
  Values truth;
  for (const auto& [path, value] : world.given) {
    const double error = random.uniform(-1, 1) * mostError(path);
    truth[path] = wrong ? value * (1 + error) : value;
  }
  return truth;
}

std::string drawSalt(Random random) {
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(random.next()),
                static_cast<unsigned long long>(random.next()));
  return text;
}

/// A motor that moves on its own behind a gear. The other engine's world has none: its rotors turn with their joints.
bool hasOwnMotor(const BlindWorld& world, const SimulatorSpec& simulator, const EffectFactory& effects) {
  const Scene scene = makeScene(world.scene, world.models, simulator, effects);
  return std::ranges::any_of(
      scene.robots, [](const SceneRobot& robot) { return std::ranges::any_of(robot.drives, &Drive::hasGear); });
}

/// Hidden effects, each large enough to be worth hiding; false if there are none in this world.
bool hide(BlindCase& blind, std::size_t wanted, const std::vector<std::string>& names, const Hideable& library,
          Random random) {
  const EffectFactory effects = withOutside(library.make);
  for (int attempt = 0; attempt < 60 && blind.simulator.effects.size() < wanted; ++attempt) {
    const auto placed = drawHidden(random, blind.world, blind.simulator, names, effects);
    if (!placed) continue;
    blind.simulator.effects.push_back(*placed);
    if (blind.answer.engine == "mujoco" && hasOwnMotor(blind.world, blind.simulator, effects)) {
      blind.simulator.effects.pop_back();
      continue;
    }
    ConcealedAnswer::Hidden hidden = describeHidden(*placed, blind.world, effects);
    // Priced alone here, so that the next one may be drawn; with all of them in the end.
    priceRemoval(hidden, blind.simulator.effects.size() - 1, blind.world, blind.simulator, library, effects);
    if (hidden.cost < leastCost) {
      blind.simulator.effects.pop_back();
    } else {
      blind.answer.hidden.push_back(hidden);
    }
  }
  if (blind.simulator.effects.size() < wanted) return false;
  for (std::size_t i = 0; i + 1 < blind.answer.hidden.size(); ++i)
    priceRemoval(blind.answer.hidden[i], i, blind.world, blind.simulator, library, effects);
  return true;
}

double measure(double value, const MeasuredColumn& column, Random& random) {
  const double noisy = value + column.noise * random.normal();
  return column.quantum > 0 ? column.quantum * std::round(noisy / column.quantum) : noisy;
}

}  // namespace

const std::vector<std::string>& caseKinds() {
  static const std::vector<std::string> kinds{"nothing", "parameters", "one", "two", "outside"};
  return kinds;
}

BlindCase drawCase(const CaseRequest& request, const Hideable& library) {
  const auto purpose = [&](const char* name) { return Random::forPurpose(request.seed, name, request.number); };
  Random choice = purpose("choice"), bodies = purpose("world");
  const std::string scene = drawScene(choice, request.engine), kind = drawKind(choice);
  BlindCase blind;
  ConcealedAnswer& answer = blind.answer;
  answer.seed = request.seed;
  answer.number = request.number;
  answer.engine = request.engine;
  answer.scene = request.scene.empty() ? scene : request.scene;
  answer.kind = request.kind.empty() ? kind : request.kind;
  if (std::find(caseKinds().begin(), caseKinds().end(), answer.kind) == caseKinds().end())
    throw InputError("--kind", answer.kind, "nothing, parameters, one, two or outside");
  if (request.engine != "ode" && request.engine != "mujoco")
    throw InputError("--engine", request.engine, "ode or mujoco");
  if (request.engine == "mujoco" && (answer.scene == "carpet" || answer.scene == "flight"))
    throw InputError("--scene", answer.scene, "pendulum, leg or walk with MuJoCo");
  const std::size_t wanted = answer.kind == "two" ? 2 : answer.kind == "one" || answer.kind == "outside" ? 1 : 0;
  std::vector<std::string> names = answer.kind == "outside" ? outsideNames() : library.names;
  std::erase(names, "measured_law");  // a table of what has no name, nothing to hide
  constexpr int worlds = 20;
  for (int world = 1;; ++world) {
    blind.world = drawWorld(answer.scene, bodies);
    answer.truth = drawTruth(blind.world, answer.kind, purpose("errors"));
    blind.simulator = {answer.truth, {}};
    answer.hidden.clear();
    if (hide(blind, wanted, names, library, purpose("hidden"))) break;
    // A ball that hardly moves shows nothing: another world.
    if (world == worlds) throw std::runtime_error("no effect acts in any of " + std::to_string(worlds) + " worlds");
  }
  for (const MeasuredColumn& column : blind.world.columns) answer.noise[column.name] = column.floor();
  answer.salt = drawSalt(purpose("salt"));
  return blind;
}

namespace {

/// CSV text by trial. `purpose` separates the noise of trials that an analyst gets from that of fresh ones.
std::vector<std::string> record(const BlindCase& blind, const Hideable& library, const std::vector<TrialPlan>& trials,
                                const char* purpose) {
  const BlindWorld& world = blind.world;
  Scene scene = makeScene(world.scene, world.models, blind.simulator, withOutside(library.make));
  scene.step_s = world.fineStep_s;
  std::vector<std::string> texts;
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    const TrialPlan& plan = trials[trial];
    const Truth truth = (blind.answer.engine == "mujoco" ? simulateMujoco : simulateOde)(scene, plan, world.columns);
    if (!truth.fault.empty()) throw std::runtime_error("reality failed: " + truth.fault);
    Random noise = Random::forPurpose(blind.answer.seed, purpose, blind.answer.number * 100 + trial);
    std::string text = "time_s";
    for (const std::size_t joint : world.commanded) {
      const std::string at = scene.robots[0].name + "." + scene.robots[0].model.joints[joint].name;
      text += "," + at + ".command_rad";
      if (world.showsEnabled) text += "," + at + ".enabled";
    }
    for (const MeasuredColumn& column : world.columns) text += "," + column.name;
    text += "\n";
    for (std::size_t row = 0; row < plan.rows; ++row) {
      // A whole number of microseconds, as a logger would write it.
      text += toText(std::round(1e6 * plan.sample_s * static_cast<double>(row)) / 1e6);
      for (const std::size_t joint : world.commanded) {
        text += "," + toText(plan.commands[row][joint]);
        if (world.showsEnabled) text += plan.enabled[row] ? ",1" : ",0";
      }
      for (std::size_t i = 0; i < world.columns.size(); ++i)
        text += "," + toText(measure(truth.values[i][row], world.columns[i], noise));
      text += "\n";
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace

std::vector<std::string> recordTrials(const BlindCase& blind, const Hideable& library) {
  return record(blind, library, blind.world.trials, "noise");
}

std::vector<std::string> recordFresh(const BlindCase& blind, const Hideable& library) {
  return record(blind, library, blind.world.fresh, "fresh noise");
}

}  // namespace btr::prove
