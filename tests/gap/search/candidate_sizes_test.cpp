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

TEST(CandidateSizes, SoftAndStiffGearsAreTriedWhereverTheSensorsSit) {
  const auto variants = variantsOf(rigScene(R"("hinge": {"p": 6})"), "gear_elasticity", "rig.hinge");
  for (const double sensors : {0.0, 1.0, 2.0, 3.0})
    EXPECT_GE(
        std::ranges::count_if(
            variants, [&](const Values& v) { return v.at("sensors") == sensors && v.at("compliance_rad_nm") >= 0.2; }),
        1)
        << sensors;
}

}  // namespace
}  // namespace btr
