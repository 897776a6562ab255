#include "core/run/reality/stand_in.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>

#include "core/run/reality/recorded_robot.h"
#include "core/sim/effect_places.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/store/database.h"

namespace btr {
namespace {

using nlohmann::json;

/// How far the default of a parameter lies from where the effect does nothing: its size on a real robot.
double typicalSize(const Parameter& p) { return p.byDefault - p.neutral.value_or(p.byDefault); }

bool hasTypicalSize(const std::vector<Parameter>& parameters) {
  return std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return typicalSize(p) != 0; });
}

/// A size that the real robot could have: each parameter lies half to one and a half times its typical size away from
/// the value at which it does nothing (log-uniform), on either side where both are possible. Bounds do not enter: they
/// say how far a search may look, not what is likely. Numbers that only shape the effect (no neutral value) keep their
/// default. `times` makes all of it larger.
Values drawSize(const std::vector<Parameter>& parameters, double times, Random& random) {
  Values values;
  for (const Parameter& p : parameters) {
    double value = p.byDefault;
    if (const double typical = typicalSize(p); typical != 0) {
      const double size = times * typical * std::exp(random.uniform(std::log(0.5), std::log(1.5)));
      const bool either = p.minimum < *p.neutral && *p.neutral < p.maximum;
      value = std::clamp(*p.neutral + (either && random.chance(0.5) ? -size : size), p.minimum, p.maximum);
    }
    values[p.name] = p.integer ? std::round(value) : value;
  }
  return values;
}

/// What a stand-in may draw where its experiment does not say. A list of its own: the reality of a seed stays what it
/// was when effects are added to the library, or a plugin to a folder.
constexpr std::array drawnByDefault{"air_drag",
                                    "anisotropic_rolling_resistance",
                                    "anisotropic_slip",
                                    "asymmetric_friction",
                                    "backlash",
                                    "command_delay",
                                    "constant_wind",
                                    "contact_compliance",
                                    "coulomb_friction",
                                    "force_offset",
                                    "gear_elasticity",
                                    "gravity_tilt",
                                    "ground_slope",
                                    "joint_spring",
                                    "load_dependent_friction",
                                    "magnus_lift",
                                    "payload",
                                    "position_offset",
                                    "restitution",
                                    "rolling_resistance",
                                    "rotor_inertia",
                                    "sensor_lag",
                                    "slip",
                                    "stribeck_friction",
                                    "torque_ripple",
                                    "torque_speed_limit",
                                    "viscous_friction",
                                    "voltage_sag"};

std::vector<std::string> drawnFrom(const ConcealedSpec& from, const PluginHost& host) {
  if (!from.effects.empty()) return from.effects;
  std::vector<std::string> names = host.effects();
  std::erase_if(names, [](const std::string& name) { return std::ranges::count(drawnByDefault, name) == 0; });
  return names;
}

/// Those of the places where an effect can sit that the experiment allows.
std::vector<std::string> allowedPlaces(Effect::Place place, const Scene& scene,
                                       const std::vector<std::string>& allowed) {
  std::vector<std::string> places = effectPlaces(place, scene, std::span(scene.robots).first(1), EffectJoints::driven);
  if (!allowed.empty())
    std::erase_if(places, [&](const std::string& at) { return std::ranges::count(allowed, at) == 0; });
  return places;
}

std::uint64_t keyOf(std::span<const double> parameters) {
  std::string bytes(parameters.size_bytes(), '\0');
  std::memcpy(bytes.data(), parameters.data(), bytes.size());
  return std::stoull(sha256(bytes).substr(0, 16), nullptr, 16);
}

}  // namespace

Concealed drawConcealed(const PreparedExperiment& prepared, const PluginHost& host) {
  const auto setting = [&](const char* name) { return valueOf(standInParameters(), prepared.spec.standIn, name); };
  const auto seed = static_cast<std::uint64_t>(setting("seed"));
  Random random = Random::forPurpose(seed, "stand-in");
  const Scene plain = prepared.scene(prepared.spec.simulator);
  const ConcealedSpec& from = prepared.spec.concealed;
  std::vector<std::string> drawable;
  for (const std::string& name : drawnFrom(from, host)) {
    const auto effect = host.effect(name);
    if (hasTypicalSize(effect->parameters()) && !allowedPlaces(effect->place(), plain, from.at).empty())
      drawable.push_back(name);
  }
  if (drawable.empty() && setting("hidden_effects") > 0 && from != ConcealedSpec{})
    throw InputError("experiment /concealed", "nothing that can be drawn",
                     "effects that have a typical size, and places of the scene where they can sit");

  while (true) {
    Concealed concealed{prepared.spec.simulator, setting("noise_m"), seed};
    const double error = setting("parameter_error");
    for (const Parameter& p : prepared.parameters) {
      const double start = valueOf(simulatorParameters(), prepared.spec.simulator.values, p.name);
      const double size = start != 0 ? std::abs(start) : 0.25 * (p.maximum - p.minimum);
      concealed.simulator.values[p.name] = std::clamp(start + error * size * random.normal(), p.minimum, p.maximum);
    }
    for (int i = 0; i < static_cast<int>(setting("hidden_effects")) && !drawable.empty(); ++i) {
      const std::string& name = drawable[random.below(drawable.size())];
      const std::shared_ptr<const Effect> effect = host.effect(name);
      const std::vector<std::string> places = allowedPlaces(effect->place(), plain, from.at);
      const std::string& at = places[random.below(places.size())];
      concealed.simulator.effects.push_back({name, at, drawSize(effect->parameters(), setting("effect_size"), random)});
    }
    try {
      prepared.scene(concealed.simulator);
      return concealed;
    } catch (const InputError&) {
      // An impossible combination (a payload that makes a mass negative, say): draw again.
    }
  }
}

RealAnswer measureStandIn(const PreparedExperiment& prepared, const Concealed& concealed,
                          std::span<const double> parameters, int repeat, const RecordTo& record,
                          const RealWorld& world) {
  const auto trial = [&](const Scene& scene, bool recordTrace) {
    return world.trial ? world.trial(prepared, scene, parameters, recordTrace)
                       : prepared.trial(scene, parameters, concealed.seed, recordTrace);
  };
  const TrialResult result = trial(prepared.scene(concealed.simulator), true);  // a fitness may read the trace
  Random random =
      Random::forPurpose(concealed.seed ^ keyOf(parameters), "measurement", static_cast<std::uint64_t>(repeat));
  RealAnswer answer;
  answer.note = world.name;
  answer.fitness = prepared.fitnessOf(result) + concealed.noise * random.normal();
  if (result.outcome != TrialResult::Outcome::finished) {
    answer.isVoid = true;
    answer.note +=
        std::string(answer.note.empty() ? "" : "; ") + "the stand-in's trial failed: " + toText(result.outcome);
  }
  if (record.file.empty()) return answer;
  // A run of its own: a robot that hangs does not kick.
  if (record.pose == RobotPose::onFloor)  // another occasion than the robot's hanging: noise of its own
    random = Random::forPurpose(concealed.seed ^ keyOf(parameters), "recording on the floor",
                                static_cast<std::uint64_t>(repeat));
  writeRecording(trial(recordedScene(prepared, concealed.simulator, record.pose), true).trace, record.file, record.pose,
                 random);
  return answer;
}

PreparedExperiment asReality(PreparedExperiment prepared, std::uint64_t runSeed) {
  Values& standIn = prepared.spec.standIn;
  const auto setting = [&](const char* name) { return valueOf(standInParameters(), standIn, name); };
  // Whole numbers below 2^53 keep their value.
  if (setting("drawn_by") == 1)
    standIn["seed"] = static_cast<double>(
        Random::forPurpose(runSeed, "stand-in of a run", static_cast<std::uint64_t>(setting("seed"))).next() >> 12);
  const double step = setting("step_s"), steps = prepared.sceneSpec.controlPeriod_s / std::max(step, 1e-9);
  if (step > 0 && std::abs(steps - std::round(steps)) > 1e-6 * steps)
    throw InputError("experiment /stand_in/step_s", toText(step),
                     "a whole part of control_period_s = " + toText(prepared.sceneSpec.controlPeriod_s));
  if (step > 0) prepared.sceneSpec.step_s = step;
  return prepared;
}

void serveStandIn(const PreparedExperiment& prepared, const PluginHost& host, std::istream& in, std::ostream& out,
                  const RealWorld& world) {
  const Concealed concealed = drawConcealed(prepared, host);
  for (std::string line; std::getline(in, line);) {
    JsonReader request = JsonReader::parse(line, "request to the stand-in");
    const std::vector<double> parameters = request.numbers("parameters", prepared.genotype.size());
    const auto repeat = static_cast<int>(request.integer("repeat", 0, 1'000'000, 0));
    const RecordTo record{request.text("record", ""), robotPose(request.text("robot", "hung_up"), "request /robot")};
    request.finish();
    const RealAnswer answer = measureStandIn(prepared, concealed, parameters, repeat, record, world);
    out << json{{"fitness", answer.fitness}, {"void", answer.isVoid}, {"note", answer.note}}.dump() << std::endl;
  }
}

}  // namespace btr
