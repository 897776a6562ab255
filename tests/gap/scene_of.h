#pragma once
#include <string>

#include "core/sim/scene.h"
#include "tests/temporary_folder.h"

namespace btr {

/// A pendulum on a turning joint "hinge" about y and a mass on a sliding joint "rail" along x, on a fixed base "rig".
/// Hinge: 0.5 kg at 0.2 m below, 0 hanging down. Rail: 2 kg. Gravity 9.81 m/s².
inline constexpr const char* rigUrdf = R"(<robot name="rig">
  <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="wall"/><child link="bob"/><axis xyz="0 1 0"/></joint>
  <link name="bob"><inertial><origin xyz="0 0 -0.2"/><mass value="0.5"/>
    <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="rail" type="prismatic"><parent link="wall"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-50" upper="50" effort="1000" velocity="100"/></joint>
  <link name="cart"><inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>)";

/// The rig with servo entries as JSON, e.g. `"hinge": {"p": 4}`; more of the scene ("floor", "balls") in `more`.
inline Scene rigScene(const std::string& servos, const std::string& more = "") {
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  const std::string json = R"({"format": "uchilsim-scene-1", "step_s": 0.0005, "control_period_s": 0.005, "robots": [
    {"name": "rig", "model": "rig.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none", "servos": {)" +
                           servos + "}}]" + (more.empty() ? "" : ", " + more) + "}";
  const SceneSpec spec = sceneFromJson(json, "scene", folder.file("."));
  return makeScene(spec, loadModels(spec), {}, {});
}

}  // namespace btr
