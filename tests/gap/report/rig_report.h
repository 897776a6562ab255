#pragma once
#include <filesystem>
#include <string>

#include "core/gap/report/report_files.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "tests/gap/report/sample_report.h"

namespace btr {

/// A robot "leg" of one servo joint "knee" on a stand, in a scene file, and the report that an analysis of it would
/// have written: a gain of 3.5 N·m/rad, and dry friction that was left out.
class RigReport {
 public:
  /// In this folder: leg.urdf, bench.json, report/.
  explicit RigReport(const std::string& folder)
      : scene(folder + "/bench.json"), report(folder + "/report"), simulator(report + "/simulator.json") {
    writeFile(folder + "/leg.urdf", urdf);
    writeFile(scene, sceneText(4));
    GapReport found = sampleReport();
    found.before = {};
    found.after = {{{"robots.leg.servos.knee.p", 3.5}}, {{"coulomb_friction", "leg.knee", {{"torque_nm", 0.05}}}}};
    found.scene = scene;
    found.sceneSha256 = sha256(readFile(scene));
    writeReport(found, report);
  }
  static std::string sceneText(double gain_nm_rad) {
    return R"({"format": "uchilsim-scene-1", "robots": [{"name": "leg", "model": "leg.urdf", "base": "fixed",
      "servos": {"knee": {"p": )" +
           std::to_string(gain_nm_rad) + R"(, "i": 0, "d": 0.03, "max_torque_nm": 1}}}]})";
  }
  static constexpr const char* urdf = R"(<robot name="leg">
  <link name="stand"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="knee" type="continuous"><parent link="stand"/><child link="shin"/><axis xyz="0 1 0"/></joint>
  <link name="shin"><inertial><origin xyz="0 0 -0.1"/><mass value="0.2"/>
    <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>)";

  std::string scene, report, simulator;
};

}  // namespace btr
