// In which sizes effects are tried.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/thresholds.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

std::vector<Values> variantsOf(const Scene& scene, const std::string& effect, const std::string& at) {
  for (const EffectCandidate& candidate : candidatesFor(scene, library(), {}, {effect}, SearchThresholds::Candidates{}))
    if (candidate.at == at) return candidate.variants;
  return {};
}

double smallest(const std::vector<Values>& variants, const std::string& name) {
  double least = INFINITY;
  for (const Values& values : variants)
    if (values.at(name) > 0) least = std::min(least, values.at(name));
  return least;
}

TEST(CandidateSizes, SoftAndStiffGearsAreTriedWhereverTheSensorsSit) {
  const auto variants = variantsOf(rigScene(R"("hinge": {"p": 6})"), "gear_elasticity", "rig.hinge");
  for (const double sensors : {0.0, 1.0, 2.0, 3.0})
    EXPECT_GE(
        std::ranges::count_if(
            variants, [&](const Values& v) { return v.at("sensors") == sensors && v.at("compliance_rad_nm") >= 0.2; }),
        1)
        << sensors;
}

// A rod of 2 g at 5 cm weighs 1 mN·m about its hinge: friction of 4 mN·m, the least of the default sizes, only jams it.
TEST(CandidateSizes, AreThoseOfSmallMechanisms) {
  const TemporaryFolder folder;
  folder.write("rod.urdf", R"(<robot name="rod">
    <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="hinge" type="continuous"><parent link="wall"/><child link="bob"/><axis xyz="0 1 0"/></joint>
    <link name="bob"><inertial><origin xyz="0 0 -0.05"/><mass value="0.002"/>
      <inertia ixx="1e-6" iyy="1e-6" izz="1e-6" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)");
  const SceneSpec spec = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.01,
    "robots": [{"name": "rod", "model": "rod.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none",
                "servos": {"hinge": {"drive": "none"}}}]})",
                                       "scene", folder.file("."));
  const Scene scene = makeScene(spec, loadModels(spec), {}, {});
  constexpr double weight_nm = 0.002 * 9.81 * 0.05;
  EXPECT_LT(smallest(variantsOf(scene, "coulomb_friction", "rod.hinge"), "torque_nm"), 0.1 * weight_nm);
  EXPECT_LT(smallest(variantsOf(scene, "viscous_friction", "rod.hinge"), "coefficient_nm_s_rad"), 1e-4);
  EXPECT_GT(smallest(variantsOf(rigScene(R"("hinge": {"p": 6})"), "coulomb_friction", "rig.hinge"), "torque_nm"), 1e-3);
}

}  // namespace
}  // namespace btr
