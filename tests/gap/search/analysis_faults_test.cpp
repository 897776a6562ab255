// A simulation that ends in a fault has no curve and no error from there on, and the report says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/report/report_html.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/sim/effect.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A joint whose simulation ends where it is opened further than `most_rad`.
class Bursting final : public Effect {
 public:
  std::vector<Parameter> parameters() const override {
    return {{"most_rad", "rad", "position above which there is no torque to speak of", 0, 10, 10, 10.0}};
  }
  Place place() const override { return Place::joint; }
  double torque(const JointState& joint, std::span<const double> values) const override {
    return joint.position > values[0] ? NAN : 0;
  }
};

EffectLibrary withBursting() {
  EffectLibrary library = btr::library();
  const EffectFactory others = library.make;
  library.make = [others](const std::string& name) -> std::shared_ptr<const Effect> {
    return name == "bursting" ? std::make_shared<Bursting>() : others(name);
  };
  library.names.push_back("bursting");
  return library;
}

/// Half-way up the recordings the simulator as given ends.
GapReport analysedAsGivenItBursts() {
  const EffectLibrary effects = withBursting();
  GapProblem problem = recordedInItsSteps();
  problem.simulator.effects = {{"bursting", "rig.hinge", {{"most_rad", 0.3}}}};
  problem.heldOut = {problem.recordings.back()};
  problem.recordings.pop_back();
  AnalysisOptions options;
  options.effects = {"coulomb_friction"};
  return analyse(problem, effects, options);
}

TEST(AnalysisFaults, LeaveNoCurveAndNoErrorWhereTheSimulationEnded) {
  const GapReport report = analysedAsGivenItBursts();
  ASSERT_EQ(report.channels.size(), 1u);
  const GapReport::Channel& channel = report.channels[0];
  EXPECT_TRUE(std::isnan(channel.asGiven)) << channel.asGiven;
  EXPECT_TRUE(std::isnan(channel.heldoutAsGiven)) << channel.heldoutAsGiven;
  EXPECT_TRUE(std::isnan(channel.heldoutMaeAsGiven)) << channel.heldoutMaeAsGiven;
  ASSERT_EQ(report.trials.size(), 3u);
  for (const GapReport::Trial& trial : report.trials) {
    const GapReport::Series& series = trial.series.at(0);
    bool ended = false;
    for (std::size_t row = 0; row < series.recorded.size(); ++row) {
      if (std::isnan(series.asGiven[row])) {
        ended = true;
        continue;
      }
      EXPECT_LT(std::abs(series.asGiven[row] - series.recorded[row]), 50 * series.noiseFloor)
          << trial.name << " " << row;
    }
    EXPECT_TRUE(ended) << trial.name;
    EXPECT_THAT(report.notes, testing::Contains(HasSubstr(trial.name + ": as given, a fault ended the simulation")));
  }
}

TEST(AnalysisFaults, AreNeitherAgreementNorPhysicsThatWasFound) {
  const GapReport report = analysedAsGivenItBursts();
  EXPECT_NE(report.verdict, GapReport::Verdict::noMismatch) << report.sentence;
  EXPECT_NE(report.verdict, GapReport::Verdict::missingPhysics) << report.sentence;
  EXPECT_NE(report.verdict, GapReport::Verdict::parametersSuffice) << report.sentence;
  EXPECT_THAT(report.sentence, HasSubstr("a fault"));
  EXPECT_THAT(toPlainText(report), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace btr
