// The score against cases counted by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gap/proof_run.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/gap/temporary_folder.h"
#include "tests/prove/prove_fixture.h"

namespace btr::prove {
namespace {

ConcealedAnswer::Hidden hiddenEffect(const std::string& effect, const std::string& at, double cost) {
  ConcealedAnswer::Hidden hidden;
  hidden.placed = {effect, at, {{"size", 2.0}, {"shape", 1.0}}};
  hidden.sizes = {"size"};
  hidden.cost = cost;
  return hidden;
}

/// A case of kind "one" whose hidden effect is at leg.knee, and a verdict without effects.
ProvedCase oneCase(const std::string& effect, double cost = 10) {
  ProvedCase proved;
  proved.answer.scene = "leg";
  proved.answer.kind = "one";
  proved.answer.hidden = {hiddenEffect(effect, "leg.knee", cost)};
  proved.answer.hidden[0].alsoAt = "leg.lower";
  proved.answer.noise = {{"leg.knee.position_rad", 0.002}};
  proved.heldOut = {{"leg.knee.position_rad", 0.003}};
  proved.verdict = "unexplained";
  return proved;
}

ProvedCase healthy(const std::string& verdict) {
  ProvedCase proved;
  proved.answer.scene = "pendulum";
  proved.answer.kind = "nothing";
  proved.verdict = verdict;
  return proved;
}

void accept(ProvedCase& proved, const std::string& effect, const std::string& at, double size = 2,
            const std::vector<PlacedEffect>& rivals = {}) {
  proved.verdict = "missing_physics";
  proved.accepted.push_back({{effect, at, {{"size", size}, {"shape", 7.0}}}, rivals});
}

TEST(Shares, HaveTheIntervalsOfClopperAndPearson) {
  // Closed forms: no hit of n: high = 1 − (α/2)^(1/n); all hits: low = (α/2)^(1/n).
  const Share none{0, 37}, all{20, 20};
  EXPECT_EQ(0, none.low());
  EXPECT_NEAR(1 - std::pow(0.025, 1.0 / 37), none.high(), 1e-12);
  EXPECT_NEAR(std::pow(0.025, 1.0 / 20), all.low(), 1e-12);
  EXPECT_EQ(1, all.high());
  // 4 of 20: the bounds are where the binomial tails are 2.5 %.
  const Share some{4, 20};
  const auto tail = [](double p, int from, int to) {
    double sum = 0;
    for (int k = from; k <= to; ++k)
      sum += std::exp(std::lgamma(21) - std::lgamma(k + 1) - std::lgamma(21 - k)) * std::pow(p, k) *
             std::pow(1 - p, 20 - k);
    return sum;
  };
  EXPECT_NEAR(0.025, tail(some.low(), 4, 20), 1e-9);
  EXPECT_NEAR(0.025, tail(some.high(), 0, 4), 1e-9);
}

TEST(Marks, AnEffectIsNamedByItselfOrAmongAtMostTwoRivals) {
  ProvedCase proved = oneCase("backlash");
  EXPECT_FALSE(*mark(proved).named);
  accept(proved, "backlash", "leg.knee");
  EXPECT_TRUE(*mark(proved).named);
  EXPECT_TRUE(*mark(proved).alone);

  const PlacedEffect truth{"backlash", "leg.knee", {}}, other{"joint_spring", "leg.knee", {}},
      third{"payload", "leg.lower", {}};
  ProvedCase rivals = oneCase("backlash");
  accept(rivals, "gear_elasticity", "leg.knee", 1, {truth, other});
  EXPECT_TRUE(*mark(rivals).named);
  rivals.accepted[0].rivals.push_back(third);
  EXPECT_FALSE(*mark(rivals).named);

  ProvedCase elsewhere = oneCase("backlash");
  accept(elsewhere, "backlash", "leg.hip");
  EXPECT_FALSE(*mark(elsewhere).named);
}

TEST(Marks, ARicherEffectIsNotTheOneItContains) {
  ProvedCase proved = oneCase("coulomb_friction");
  accept(proved, "stribeck_friction", "leg.knee");
  EXPECT_FALSE(*mark(proved).named);
  EXPECT_EQ((std::pair<std::string, std::string>{"coulomb_friction", "stribeck_friction"}),
            mark(proved).confused.at(0));
}

TEST(Marks, BelowThreeNoiseFloorsNothingIsAsked) {
  ProvedCase proved = oneCase("backlash", 2.9);
  EXPECT_FALSE(mark(proved).named.has_value());
  EXPECT_FALSE(mark(proved).location.has_value());
  EXPECT_TRUE(mark(proved).heldOutNear.has_value());
}

TEST(Marks, TurnedGravityIsASlopeWhereThereIsAFloorAndOnlyThere) {
  ProvedCase proved = oneCase("ground_slope");
  proved.answer.hidden[0].placed.at = "floor";
  proved.answer.scene = "carpet";
  accept(proved, "gravity_tilt", "world");
  EXPECT_TRUE(*mark(proved).named);
  EXPECT_TRUE(*mark(proved).location);
  proved.answer.scene = "leg";
  EXPECT_FALSE(*mark(proved).named);
}

TEST(Marks, APlaceIsRightByEffectByCarriedLinkByCurveOrByChannel) {
  ProvedCase proved = oneCase("backlash");
  EXPECT_FALSE(*mark(proved).location);
  proved.worstChannel = "leg.knee.position_rad";
  EXPECT_TRUE(*mark(proved).location);
  accept(proved, "payload", "leg.upper");
  EXPECT_FALSE(*mark(proved).location);
  proved.remainderAt = "leg.knee";
  EXPECT_TRUE(*mark(proved).location);
  ProvedCase carried = oneCase("backlash");
  accept(carried, "payload", "leg.lower");
  EXPECT_TRUE(*mark(carried).location);
}

TEST(Marks, ParameterErrorsAreThoseOfSizesOfWhatWasNamed) {
  ProvedCase proved = oneCase("backlash");
  accept(proved, "backlash", "leg.knee", 2.5);  // the true size is 2; its shape is not asked for
  ASSERT_EQ(1u, mark(proved).parameterErrors.size());
  EXPECT_DOUBLE_EQ(0.25, mark(proved).parameterErrors[0]);
  EXPECT_DOUBLE_EQ(1.5, *mark(proved).heldOut);
  EXPECT_TRUE(*mark(proved).heldOutNear);
}

TEST(Scores, CountWhatWasCountedByHand) {
  std::vector<ProvedCase> cases;
  // Ten healthy ones: one alarm by a name, one by "unexplained", one failed.
  for (int i = 0; i < 7; ++i) cases.push_back(healthy(i % 2 ? "no_mismatch" : "parameters_suffice"));
  cases.push_back(healthy("missing_physics"));
  cases.push_back(healthy("unexplained"));
  cases.push_back(healthy(""));
  cases.back().failure = "it broke";
  // Three with one effect: named, named as a rival, missed.
  for (int i = 0; i < 3; ++i) cases.push_back(oneCase("backlash"));
  accept(cases[10], "backlash", "leg.knee", 2.2);
  accept(cases[11], "joint_spring", "leg.knee", 1, {{"backlash", "leg.knee", {}}});
  // Two with two effects: both, and one of two.
  for (int i = 0; i < 2; ++i) {
    cases.push_back(oneCase("backlash"));
    cases.back().answer.kind = "two";
    cases.back().answer.hidden.push_back(hiddenEffect("command_delay", "leg.hip", 5));
    accept(cases.back(), "backlash", "leg.knee", 1.8);
  }
  accept(cases[13], "command_delay", "leg.hip", 1.0);
  // Two from outside: one honest, one confidently wrong.
  for (int i = 0; i < 2; ++i) {
    cases.push_back(oneCase("outside_cubic_spring"));
    cases.back().answer.kind = "outside";
    cases.back().answer.hidden[0].outside = true;
  }
  accept(cases[16], "joint_spring", "leg.knee");

  const ProofScore total = score(cases);
  const auto expect = [](int hits, int of, const Share& share) {
    EXPECT_EQ(hits, share.hits);
    EXPECT_EQ(of, share.cases);
  };
  EXPECT_EQ(17, total.all.cases);
  EXPECT_EQ(1, total.all.failed);
  expect(3, 10, total.all.falseAlarms);
  expect(2, 3, total.all.named);
  expect(2, 3, total.all.alone);
  expect(1, 2, total.all.bothNamed);
  expect(1, 2, total.all.confidentlyWrong);
  expect(1, 2, total.all.unexplained);
  // Knee by effect, by effect, nowhere; outside: nowhere, by effect.
  expect(3, 5, total.all.location);
  // Sizes found 2.2, 1.8, 1.8, 1.0 of 2: errors 10, 10, 10, 50 %.
  EXPECT_NEAR(0.1, middleOf(total.all.parameterErrors), 1e-12);
  EXPECT_EQ(3, total.confusion.at({"backlash", "backlash"}));
  EXPECT_EQ(1, total.confusion.at({"backlash", "backlash (rival)"}));
  EXPECT_EQ(1, total.confusion.at({"backlash", "(unexplained)"}));
  EXPECT_EQ(1, total.confusion.at({"command_delay", "command_delay"}));
  EXPECT_EQ(1, total.confusion.at({"command_delay", "(missing_physics)"}));
  EXPECT_EQ(2u, total.byScene.size());
  for (const ProofBar& bar : total.bars) EXPECT_TRUE(bar.asked) << bar.question;
}

TEST(Scores, SurviveBeingWrittenAndRead) {
  ProvedCase proved = oneCase("backlash");
  accept(proved, "joint_spring", "leg.knee", 1, {{"backlash", "leg.knee", {}}});
  proved.calibrated = {{"robots.leg.servos.knee.p", 3.7}};
  proved.seconds = 12.5;
  EXPECT_EQ(toJsonText(proved), toJsonText(provedFromJson(toJsonText(proved), "verdict")));
}

/// Says of everything that nothing is missing.
GapReport contentAnalyst(const AnalysisRequest& request, const EffectLibrary&) {
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(request.scene).parent_path() / "answer.json"));
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(request.scene).parent_path() / "seal.txt"));
  EXPECT_EQ(8u, request.recordings.size());
  GapReport report;
  report.verdict = GapReport::Verdict::noMismatch;
  return report;
}

TEST(Proof, ConcealsAnalysesOpensAndGoesOnWhereItStopped) {
  const TemporaryFolder folder;
  ProofRequest request;
  request.generator = CONCEAL_PROGRAM;
  request.out = folder.file("proof");
  request.seed = 3;
  request.cases = 2;
  request.scene = "flight";
  request.kind = "nothing";
  request.jobs = 2;
  const std::atomic<bool> stop{false};
  EXPECT_EQ(2u, runProof(request, {}, contentAnalyst, stop).size());
  // Finished cases are kept: an analyst that would fail is not asked again.
  const Analyse broken = [](const AnalysisRequest&, const EffectLibrary&) -> GapReport { throw InputError("broken"); };
  request.cases = 3;
  const auto cases = runProof(request, {}, broken, stop);
  ASSERT_EQ(3u, cases.size());
  EXPECT_EQ("no_mismatch", cases[1].verdict);
  EXPECT_EQ("broken", cases[2].failure);
  const auto proof = nlohmann::json::parse(readFile(folder.file("proof/proof.json")));
  EXPECT_EQ(1, proof["all"]["false_alarms"]["hits"]);
  EXPECT_EQ(3, proof["all"]["false_alarms"]["cases"]);
  EXPECT_NE(std::string::npos, readFile(folder.file("proof/proof.html")).find("NOT MET"));
  // Another trial does not fit in.
  request.seed = 4;
  EXPECT_THROW(runProof(request, {}, broken, stop), InputError);
}

}  // namespace
}  // namespace btr::prove
