#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

class JsonReader;

/// An effect that was added to the simulator: its plugin's name, its place, its parameters (all of them, in SI units).
struct PlacedEffect {
  std::string effect;  ///< e.g. "backlash"
  std::string at;      ///< "ROBOT.JOINT", "ROBOT.*" (all its joints), "ROBOT.LINK", a ball's name, "floor", "world"
  Values parameters;
  bool operator==(const PlacedEffect&) const = default;
  std::string text() const { return effect + " at " + at; }
};

/// What a fit produced and what a run uses: numbers that replace those of scene and model, and added effects.
/// A key of `values` is one of simulatorParameters() ("leg_mass_kg") or a path into the scene
/// ("robots.leg.servos.knee.p"). A simulator is a value: it is never edited, a changed one is a new version.
struct SimulatorSpec {
  Values values;
  std::vector<PlacedEffect> effects;
  bool operator==(const SimulatorSpec&) const = default;
};

/// The 12 adaptable parameters of UCHILSIM with units, search ranges and starting values
/// (sources: manual/formats/simulator.md): head_mass_kg, neck_mass_kg, body_mass_kg, leg_mass_kg (one leg),
/// friction, gravity_m_s2, slip1_m_s_n, slip2_m_s_n, servo_p_nm_rad, servo_i_nm_rad_s, servo_d_nm_s_rad,
/// servo_max_torque_nm. The servo numbers are those of a leg's J1; the other joints keep their ratio to it that the
/// robot's file gives.
const std::vector<Parameter>& simulatorParameters();

/// "format": "uchilsim-simulator-1". `place` begins error messages.
SimulatorSpec simulatorFromJson(const std::string& text, const std::string& place);
SimulatorSpec loadSimulator(const std::string& path);
std::string toJsonText(const SimulatorSpec& simulator);

/// The same as a part of a larger document: keys "values" and "effects" of an object. The caller calls finish().
SimulatorSpec simulatorFromReader(JsonReader& reader);
nlohmann::json simulatorToJson(const SimulatorSpec& simulator);

}  // namespace btr
