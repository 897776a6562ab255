#include "core/spec/simulator_spec.h"

#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"

namespace btr {

const std::vector<Parameter>& simulatorParameters() {
  static const std::vector<Parameter> parameters{
      {"head_mass_kg", "kg", "mass of the head", 0.10, 0.30, 0.19},
      {"neck_mass_kg", "kg", "mass of the neck", 0.01, 0.10, 0.025},
      {"body_mass_kg", "kg", "mass of the body", 0.4, 1.0, 0.62},
      {"leg_mass_kg", "kg", "mass of one leg", 0.12, 0.30, 0.20},
      {"friction", "", "Coulomb friction coefficient of the floor", 0.3, 2.0, 1.0},
      {"gravity_m_s2", "m/s²", "gravitational acceleration downwards", 8.8, 10.8, 9.81},
      {"slip1_m_s_n", "m/(s·N)", "sliding speed per tangential force along the floor's x", 0, 0.05, 0.01},
      {"slip2_m_s_n", "m/(s·N)", "sliding speed per tangential force along the floor's y", 0, 0.05, 0.01},
      {"servo_p_nm_rad", "N·m/rad", "servo's proportional gain", 2, 30, 7.5},
      {"servo_i_nm_rad_s", "N·m/(rad·s)", "servo's integral gain", 0, 5, 0},
      {"servo_d_nm_s_rad", "N·m·s/rad", "servo's damping", 0, 0.5, 0.05},
      {"servo_max_torque_nm", "N·m", "servo's largest torque", 0.3, 1.6, 0.85},
  };
  return parameters;
}

SimulatorSpec simulatorFromReader(JsonReader& reader) {
  SimulatorSpec simulator;
  simulator.values = reader.anyValues("values");
  for (const auto& [name, value] : simulator.values)
    if (const Parameter* parameter = find(simulatorParameters(), name))
      check(*parameter, value, reader.at("values") + "/" + name);
  reader.array("effects", [&](JsonReader entry) {
    PlacedEffect effect;
    effect.effect = entry.text("effect");
    effect.at = entry.text("at");
    effect.parameters = entry.anyValues("parameters");
    entry.finish();
    simulator.effects.push_back(std::move(effect));
  });
  return simulator;
}

nlohmann::json simulatorToJson(const SimulatorSpec& simulator) {
  nlohmann::json effects = nlohmann::json::array();
  for (const PlacedEffect& effect : simulator.effects)
    effects.push_back({{"effect", effect.effect}, {"at", effect.at}, {"parameters", toJson(effect.parameters, {})}});
  return {{"values", toJson(simulator.values, simulatorParameters())}, {"effects", effects}};
}

SimulatorSpec simulatorFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  reader.word("format", {"uchilsim-simulator-1"});
  SimulatorSpec simulator = simulatorFromReader(reader);
  reader.finish();
  return simulator;
}

SimulatorSpec loadSimulator(const std::string& path) { return simulatorFromJson(readFile(path), path); }

std::string toJsonText(const SimulatorSpec& simulator) {
  nlohmann::json document = simulatorToJson(simulator);
  document["format"] = "uchilsim-simulator-1";
  return document.dump(2) + "\n";
}

}  // namespace btr
