#include "core/run/stand_in.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/store/database.h"

namespace btr {
namespace {

using nlohmann::json;

/// Places where an effect of this kind can sit.
std::vector<std::string> placesFor(Effect::Place place, const Scene& scene) {
  std::vector<std::string> places;
  const SceneRobot& robot = scene.robots.front();
  switch (place) {
    case Effect::Place::joint:
      for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
        if (robot.drives[j].kind != Drive::Kind::none) places.push_back(robot.name + "." + robot.model.joints[j].name);
      break;
    case Effect::Place::link:
      for (const Link& link : robot.model.links) places.push_back(robot.name + "." + link.name);
      break;
    case Effect::Place::ball:
      for (const BallSpec& ball : scene.balls) places.push_back(ball.name);
      break;
    case Effect::Place::floor:
      if (scene.floor) places.push_back("floor");
      break;
    case Effect::Place::world:
      places.push_back("world");
      break;
  }
  return places;
}

/// How far the default of a parameter lies from where the effect does nothing: its size on a real robot.
double typicalSize(const Parameter& p) { return p.byDefault - p.neutral.value_or(p.byDefault); }

bool hasTypicalSize(const std::vector<Parameter>& parameters) {
  return std::any_of(parameters.begin(), parameters.end(), [](const Parameter& p) { return typicalSize(p) != 0; });
}

/// A size that the real robot could have: each parameter lies half to one and a half times its typical size away from
/// the value at which it does nothing (log-uniform), on either side where both are possible. Bounds do not enter: they
/// say how far a search may look, not what is likely. Numbers that only shape the effect (no neutral value) keep their
/// default.
Values drawSize(const std::vector<Parameter>& parameters, Random& random) {
  Values values;
  for (const Parameter& p : parameters) {
    double value = p.byDefault;
    if (const double typical = typicalSize(p); typical != 0) {
      const double size = typical * std::exp(random.uniform(std::log(0.5), std::log(1.5)));
      const bool either = p.minimum < *p.neutral && *p.neutral < p.maximum;
      value = std::clamp(*p.neutral + (either && random.chance(0.5) ? -size : size), p.minimum, p.maximum);
    }
    values[p.name] = p.integer ? std::round(value) : value;
  }
  return values;
}

std::uint64_t keyOf(std::span<const double> parameters) {
  std::string bytes(parameters.size_bytes(), '\0');
  std::memcpy(bytes.data(), parameters.data(), bytes.size());
  return std::stoull(sha256(bytes).substr(0, 16), nullptr, 16);
}

void writeRecording(const Trace& trace, const std::string& path, Random& random) {
  std::string text;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < trace.channels.size(); ++c) {
    const std::string& name = trace.channels[c];
    const bool wanted = name == "time_s" || name.ends_with(".command_rad") || name.ends_with(".position_rad") ||
                        (name.starts_with("ball") && (name.ends_with(".x_m") || name.ends_with(".y_m")));
    if (!wanted) continue;
    text += (kept.empty() ? "" : ",") + name;
    kept.push_back(c);
  }
  text += '\n';
  for (std::size_t row = 0; row < trace.rows(); ++row) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const std::string& name = trace.channels[kept[i]];
      double value = trace.at(row, kept[i]);
      // A potentiometer's and a camera's noise and resolution.
      if (name.ends_with(".position_rad")) value = std::round((value + 0.001 * random.normal()) * 1000) / 1000;
      if (name.ends_with("_m")) value = std::round((value + 0.002 * random.normal()) * 1000) / 1000;
      text += (i ? "," : "") + toText(value);
    }
    text += '\n';
  }
  writeFile(path, text);
}

}  // namespace

Concealed drawConcealed(const PreparedExperiment& prepared, const PluginHost& host) {
  const auto setting = [&](const char* name) { return valueOf(standInParameters(), prepared.spec.standIn, name); };
  const auto seed = static_cast<std::uint64_t>(setting("seed"));
  Random random = Random::forPurpose(seed, "stand-in");
  const Scene plain = prepared.scene(prepared.spec.simulator);
  std::vector<std::string> drawable;
  for (const std::string& name : host.effects()) {
    const auto effect = host.effect(name);
    if (hasTypicalSize(effect->parameters()) && !placesFor(effect->place(), plain).empty()) drawable.push_back(name);
  }

  while (true) {
    Concealed concealed{prepared.spec.simulator, setting("noise_m"), seed};
    const double error = setting("parameter_error");
    for (const Parameter& p : simulatorParameters()) {
      const double start = valueOf(simulatorParameters(), prepared.spec.simulator.values, p.name);
      const double size = start != 0 ? std::abs(start) : 0.25 * (p.maximum - p.minimum);
      concealed.simulator.values[p.name] = std::clamp(start + error * size * random.normal(), p.minimum, p.maximum);
    }
    for (int i = 0; i < static_cast<int>(setting("hidden_effects")) && !drawable.empty(); ++i) {
      const std::string& name = drawable[random.below(drawable.size())];
      const std::shared_ptr<const Effect> effect = host.effect(name);
      const std::vector<std::string> places = placesFor(effect->place(), plain);
      const std::string& at = places[random.below(places.size())];
      concealed.simulator.effects.push_back({name, at, drawSize(effect->parameters(), random)});
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
                          std::span<const double> parameters, int repeat, const std::string& recordTo) {
  const Scene scene = prepared.scene(concealed.simulator);
  const TrialResult result = prepared.trial(scene, parameters, concealed.seed, !recordTo.empty());
  Random random =
      Random::forPurpose(concealed.seed ^ keyOf(parameters), "measurement", static_cast<std::uint64_t>(repeat));
  RealAnswer answer;
  answer.fitness = prepared.fitnessOf(result) + concealed.noise * random.normal();
  if (result.outcome != TrialResult::Outcome::finished) {
    answer.isVoid = true;
    answer.note = std::string("the stand-in's trial failed: ") + toText(result.outcome);
  }
  if (!recordTo.empty()) writeRecording(result.trace, recordTo, random);
  return answer;
}

void serveStandIn(const PreparedExperiment& prepared, const PluginHost& host, std::istream& in, std::ostream& out) {
  const Concealed concealed = drawConcealed(prepared, host);
  for (std::string line; std::getline(in, line);) {
    JsonReader request = JsonReader::parse(line, "request to the stand-in");
    const std::vector<double> parameters = request.numbers("parameters", prepared.genotype.size());
    const auto repeat = static_cast<int>(request.integer("repeat", 0, 1'000'000, 0));
    const std::string record = request.text("record", "");
    request.finish();
    const RealAnswer answer = measureStandIn(prepared, concealed, parameters, repeat, record);
    out << json{{"fitness", answer.fitness}, {"void", answer.isVoid}, {"note", answer.note}}.dump() << std::endl;
  }
}

}  // namespace btr
