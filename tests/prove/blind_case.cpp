#include "tests/prove/blind_case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

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

/// Columns of one sensor: a joint's angle and rate, a body's or ball's pose.
std::vector<int> sensorsOf(const BlindWorld& world) {
  std::vector<std::string> names;
  std::vector<int> groups;
  for (const MeasuredColumn& column : world.columns) {
    const std::string sensor = column.name.substr(0, column.name.rfind('.'));
    auto found = std::find(names.begin(), names.end(), sensor);
    if (found == names.end()) found = names.insert(names.end(), sensor);
    groups.push_back(static_cast<int>(found - names.begin()));
  }
  return groups;
}

/// Which trials are not what their files say: by trial, the factor of its commands, or 1 where the measuring is at
/// fault.
std::map<std::size_t, double> drawSpoiled(std::size_t wanted, const BlindWorld& world, Random random) {
  std::map<std::size_t, double> spoiled;
  const std::size_t most = world.trials.size() / 3;
  while (spoiled.size() < std::min(wanted, most)) {
    const std::size_t trial = random.below(world.trials.size());
    const double factor = random.chance(0.5) ? random.uniform(0.6, 0.85) : random.uniform(1.2, 1.5);
    const bool commands = !world.commanded.empty() && random.chance(0.5);
    spoiled.emplace(trial, commands ? factor : 1);
  }
  return spoiled;
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
  blind.dirt = drawDirt(request.dirt, sensorsOf(blind.world), !blind.world.commanded.empty(), purpose("logger"));
  blind.spoiled = drawSpoiled(request.spoiled, blind.world, purpose("spoiled"));
  answer.dirt = request.dirt;
  for (const auto& [trial, factor] : blind.spoiled)
    answer.spoiled.push_back("trial_" + std::to_string(trial + 1) + ".csv");
  answer.salt = drawSalt(purpose("salt"));
  return blind;
}

namespace {

/// By trial. `purpose` separates the noise of trials that an analyst gets from that of fresh ones. Trials in `wrong`
/// were commanded otherwise than their files say.
std::vector<LoggedTrial> record(const BlindCase& blind, const Hideable& library, const std::vector<TrialPlan>& trials,
                                const char* purpose, const std::map<std::size_t, double>& wrong) {
  const BlindWorld& world = blind.world;
  Scene scene = makeScene(world.scene, world.models, blind.simulator, withOutside(library.make));
  scene.step_s = world.fineStep_s;
  std::vector<LoggedTrial> logged;
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    const TrialPlan& plan = trials[trial];
    TrialPlan done = plan;
    if (const auto found = wrong.find(trial); found != wrong.end())
      for (auto& row : done.commands)
        for (double& command : row) command *= found->second;
    const Truth truth = (blind.answer.engine == "mujoco" ? simulateMujoco : simulateOde)(scene, done, world.columns);
    if (!truth.fault.empty()) throw std::runtime_error("reality failed: " + truth.fault);
    Random noise = Random::forPurpose(blind.answer.seed, purpose, blind.answer.number * 100 + trial);
    LoggedTrial log;
    log.columns.push_back("time_s");
    for (const std::size_t joint : world.commanded) {
      const std::string at = scene.robots[0].name + "." + scene.robots[0].model.joints[joint].name;
      log.columns.push_back(at + ".command_rad");
      if (world.showsEnabled) log.columns.push_back(at + ".enabled");
    }
    log.firstMeasured = log.columns.size();
    for (const MeasuredColumn& column : world.columns) log.columns.push_back(column.name);
    for (std::size_t row = 0; row < plan.rows; ++row) {
      auto& cells = log.rows.emplace_back();
      cells.push_back(plan.sample_s * static_cast<double>(row));
      for (const std::size_t joint : world.commanded) {
        cells.push_back(plan.commands[row][joint]);
        if (world.showsEnabled) cells.push_back(plan.enabled[row] ? 1 : 0);
      }
      for (std::size_t i = 0; i < world.columns.size(); ++i)
        cells.push_back(measure(truth.values[i][row], world.columns[i], noise));
    }
    logged.push_back(std::move(log));
  }
  return logged;
}

std::vector<std::string> textsOf(const std::vector<LoggedTrial>& trials) {
  std::vector<std::string> texts;
  for (const LoggedTrial& trial : trials) texts.push_back(csvOf(trial));
  return texts;
}

}  // namespace

std::vector<std::string> recordTrials(const BlindCase& blind, const Hideable& library) {
  const BlindWorld& world = blind.world;
  auto trials = record(blind, library, world.trials, "noise", blind.spoiled);
  std::vector<double> noises;
  for (const MeasuredColumn& column : world.columns) noises.push_back(column.floor());
  for (std::size_t trial = 0; trial < trials.size(); ++trial) {
    const auto purpose = [&](const char* name) {
      return Random::forPurpose(blind.answer.seed, name, blind.answer.number * 100 + trial);
    };
    if (const auto found = blind.spoiled.find(trial); found != blind.spoiled.end() && found->second == 1)
      spoil(trials[trial], noises, purpose("spoiling"));
    soil(trials[trial], blind.dirt, world.trials[trial].sample_s, purpose("dirt"));
  }
  return textsOf(trials);
}

std::vector<std::string> recordFresh(const BlindCase& blind, const Hideable& library) {
  return textsOf(record(blind, library, blind.world.fresh, "fresh noise", {}));
}

}  // namespace btr::prove
