// The score against cases counted by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/proof/proof_json.h"
#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proof_run.h"
#include "core/gap/proof/proof_tally.h"
#include "core/gap/proof/proof_text.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/prove/prove_fixture.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

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
  proved.fresh = {{"leg.knee.position_rad", 0.003}};
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
            const std::vector<ProvedCase::Rival>& rivals = {}) {
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

  const ProvedCase::Rival truth{"backlash", "leg.knee"}, other{"joint_spring", "leg.knee"},
      third{"payload", "leg.lower"};
  ProvedCase rivals = oneCase("backlash");
  accept(rivals, "gear_elasticity", "leg.knee", 1, {truth, other});
  EXPECT_TRUE(*mark(rivals).named);
  rivals.accepted[0].rivals.push_back(third);
  EXPECT_FALSE(*mark(rivals).named);

  ProvedCase elsewhere = oneCase("backlash");
  accept(elsewhere, "backlash", "leg.hip");
  EXPECT_FALSE(*mark(elsewhere).named);
}

TEST(Marks, ARivalThatHoldsOnlyBesideAnotherNamesWhatIsHiddenWhereBothAre) {
  const ProvedCase::Rival dry{"coulomb_friction", "leg.knee", "force_offset"},
      constant{"force_offset", "leg.knee", "coulomb_friction"};
  ProvedCase half = oneCase("coulomb_friction");
  accept(half, "asymmetric_friction", "leg.knee", 1, {dry, constant});
  EXPECT_FALSE(*mark(half).named);
  EXPECT_TRUE(*mark(half).location);
  EXPECT_EQ("asymmetric_friction", mark(half).confused.at(0).second);

  ProvedCase whole = half;
  whole.answer.kind = "two";
  whole.answer.hidden.push_back(hiddenEffect("force_offset", "leg.knee", 5));
  EXPECT_TRUE(*mark(whole).bothNamed);
  // Its partner is hidden too, but at another joint.
  whole.answer.hidden[1].placed.at = "leg.hip";
  EXPECT_FALSE(*mark(whole).bothNamed);
  EXPECT_EQ("asymmetric_friction", mark(whole).confused.at(0).second);
}

TEST(Marks, NumbersThatAreChangedWhereNothingIsWrongAreCounted) {
  EXPECT_TRUE(*mark(healthy("parameters_suffice")).numbersChanged);
  EXPECT_FALSE(*mark(healthy("no_mismatch")).numbersChanged);
  EXPECT_FALSE(*mark(healthy("missing_physics")).numbersChanged);  // a false alarm, which is counted as such
  ProvedCase wrong = healthy("parameters_suffice");
  wrong.answer.kind = "parameters";
  EXPECT_FALSE(mark(wrong).numbersChanged.has_value());
  ProvedCase broken = healthy("");
  broken.failure = "it broke";
  EXPECT_TRUE(*mark(broken).numbersChanged);
}

TEST(Marks, AnIntervalIsAskedForWhereTheVerdictIsRightAndTheNumberExcited) {
  ProvedCase proved = healthy("parameters_suffice");
  proved.answer.kind = "parameters";
  proved.answer.truth = {{"inside", 1.0}, {"edge", 2.0}, {"outside", 3.0}, {"silent", 4.0}, {"absent", 5.0}};
  proved.calibratedTold = {{"inside", {{0.9, 1.2}, true}},
                           {"edge", {{2.0, 2.2}, true}},
                           {"outside", {{3.1, 3.2}, true}},
                           {"silent", {{4.1, 4.2}, false}}};
  // In the order of their names: edge, inside, outside.
  EXPECT_EQ((std::vector<bool>{true, true, false}), mark(proved).calibratedCovered);
  EXPECT_EQ((std::vector<bool>{true, true, false}), mark(proved).calibratedAmongRivals);
  proved.calibratedTold["outside"].amongRivals = {2.9, 3.2};
  EXPECT_EQ((std::vector<bool>{true, true, false}), mark(proved).calibratedCovered);
  EXPECT_EQ((std::vector<bool>{true, true, true}), mark(proved).calibratedAmongRivals);
  proved.verdict = "no_mismatch";
  EXPECT_TRUE(mark(proved).calibratedCovered.empty());
  proved.answer.kind = "nothing";
  EXPECT_EQ(3u, mark(proved).calibratedCovered.size());
  proved.answer.kind = "outside";
  EXPECT_TRUE(mark(proved).calibratedCovered.empty());
}

TEST(Marks, TheIntervalOfASizeIsAskedForWhereItsEffectIsNamedAtItsPlace) {
  ProvedCase proved = oneCase("backlash");  // its size is 2
  accept(proved, "backlash", "leg.knee", 2.5);
  auto& told = proved.accepted[0].told;
  told = {{"size", {{2.4, 2.6}, true}}, {"shape", {{0.0, 9.0}, true}}};
  EXPECT_EQ(std::vector<bool>{false}, mark(proved).parametersCovered);
  EXPECT_EQ(std::vector<bool>{false}, mark(proved).parametersAmongRivals);
  told["size"].amongRivals = {1.9, 2.6};
  EXPECT_EQ(std::vector<bool>{false}, mark(proved).parametersCovered);
  EXPECT_EQ(std::vector<bool>{true}, mark(proved).parametersAmongRivals);
  told["size"].ci95.low = 1.9;
  EXPECT_EQ(std::vector<bool>{true}, mark(proved).parametersCovered);
  told["size"].ci95 = {2, 2};  // a whole number, tried and not fitted
  EXPECT_TRUE(mark(proved).parametersCovered.empty());
  told["size"] = {{1.9, 2.6}, false};
  EXPECT_TRUE(mark(proved).parametersCovered.empty());
  proved.accepted[0].placed.at = "leg.hip";
  told["size"].excited = true;
  EXPECT_TRUE(mark(proved).parametersCovered.empty());
}

TEST(Marks, WhatIsScoredComesWithTheReportAndTheFreshRecordings) {
  GapReport report;
  report.verdict = GapReport::Verdict::missingPhysics;
  GapReport::Effect effect;
  effect.effect = "backlash";
  effect.at = "leg.knee";
  effect.accepted = true;
  effect.parameters = {{"size", "rad", 0, 2.5, {2.4, 2.6}, false, true}};
  effect.rivals = {{"coulomb_friction", "leg.knee", 1, "force_offset"}};
  report.tried = {effect};
  report.calibrated = {{"p", "", 1, 1.1, {1.0, 1.2}, false, false}};
  report.channels.resize(1);
  report.channels[0].name = "leg.knee.position_rad";
  report.channels[0].withEffects = 0.002;  // of the cross-validation: not what is scored
  const ProvedCase proved = judged(oneCase("backlash").answer, report, {{"leg.knee.position_rad", 0.004}});
  EXPECT_DOUBLE_EQ(2, *mark(proved).heldOut);
  EXPECT_FALSE(*mark(proved).heldOutNear);
  EXPECT_EQ("force_offset", proved.accepted.at(0).rivals.at(0).with);
  EXPECT_EQ(2.4, proved.accepted[0].told.at("size").ci95.low);
  EXPECT_FALSE(proved.calibratedTold.at("p").excited);
  EXPECT_FALSE(*mark(judged(oneCase("backlash").answer, report, {})).heldOutNear);
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
  accept(cases[11], "joint_spring", "leg.knee", 1, {{"backlash", "leg.knee"}});
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
  cases[10].accepted[0].told = {{"size", {{1.9, 2.5}, true}}};
  cases[12].answer.truth = cases[13].answer.truth = {{"p", 3.0}};
  cases[13].calibratedTold = {{"p", {{3.1, 3.3}, true}}};

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
  // Four of seven had numbers changed, and one analysis broke.
  expect(5, 10, total.all.numbersChanged);
  EXPECT_EQ(4, total.verdicts.at({"nothing", "parameters_suffice"}));
  EXPECT_EQ(3, total.verdicts.at({"nothing", "no_mismatch"}));
  EXPECT_EQ(1, total.verdicts.at({"nothing", "failed"}));
  EXPECT_EQ(2, total.verdicts.at({"two", "missing_physics"}));
  expect(1, 1, total.all.parametersCovered);
  expect(0, 1, total.all.calibratedCovered);
  const auto proof = nlohmann::json::parse(proofJson(total, cases));
  EXPECT_EQ(5, proof["all"]["numbers_changed_without_need"]["hits"]);
  EXPECT_NEAR(total.all.numbersChanged.low(), proof["all"]["numbers_changed_without_need"]["ci95"][0], 1e-15);
  EXPECT_EQ(1, proof["all"]["parameters_in_ci95"]["hits"]);
  EXPECT_EQ(0, proof["all"]["calibrated_in_ci95"]["hits"]);
  EXPECT_EQ(1, proof["all"]["parameters_among_rivals"]["hits"]);
  for (const std::string& text : {proofText(total), proofHtml(total)}) {
    EXPECT_NE(std::string::npos, text.find("5/10 = 50.0 % (18.7 to 81.3)"));
    EXPECT_NE(std::string::npos, text.find("Kind of case"));
  }
  for (const ProofBar& bar : total.bars) EXPECT_TRUE(bar.asked) << bar.question;
}

TEST(Scores, SurviveBeingWrittenAndRead) {
  ProvedCase proved = oneCase("backlash");
  accept(proved, "joint_spring", "leg.knee", 1, {{"backlash", "leg.knee"}, {"slip", "floor", "payload"}});
  proved.accepted[0].told = {{"size", {{0.9, 1.1}, true}}};
  proved.calibrated = {{"robots.leg.servos.knee.p", 3.7}};
  // What recordings do not tell is open on both sides; a whole number has no interval at all.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  proved.calibratedTold = {{"robots.leg.servos.hip.max_torque_nm", {{-infinity, infinity}, false}},
                           {"robots.leg.servos.hip.p", {GapReport::Interval::none(), true}},
                           {"robots.leg.servos.knee.p", {{3.5, 3.9}, false, {3.1, 3.9}}}};
  proved.seconds = 12.5;
  const ProvedCase read = provedFromJson(toJsonText(proved), "verdict");
  EXPECT_EQ(toJsonText(proved), toJsonText(read));
  EXPECT_EQ(infinity, read.calibratedTold.at("robots.leg.servos.hip.max_torque_nm").ci95.high);
  EXPECT_FALSE(read.calibratedTold.at("robots.leg.servos.hip.p").ci95.known());
  EXPECT_EQ(3.1, read.calibratedTold.at("robots.leg.servos.knee.p").amongRivals.low);
}

/// Says of everything that nothing is missing.
GapReport contentAnalyst(const AnalysisRequest& request, const EffectLibrary&) {
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(request.scene).parent_path() / "answer.json"));
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(request.scene).parent_path() / "seal.txt"));
  EXPECT_EQ(8u, request.recordings.size());
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(request.scene).parent_path() / "fresh"));
  GapReport report;
  report.verdict = GapReport::Verdict::noMismatch;
  return report;
}

/// Two balls in flight with nothing to be found, into the folder's `proof`.
ProofRequest twoFlights(const std::string& generator, const TemporaryFolder& folder) {
  ProofRequest request;
  request.generator = generator;
  request.out = folder.file("proof");
  request.seed = 3;
  request.cases = 2;
  request.scene = "flight";
  request.kind = "nothing";
  return request;
}

TEST(Proof, ConcealsAnalysesOpensAndGoesOnWhereItStopped) {
  const TemporaryFolder folder;
  ProofRequest request = twoFlights(CONCEAL_PROGRAM, folder);
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
  // What is given is true here: in recordings made after the verdict it leaves the noise, and no more.
  EXPECT_NEAR(1, proof["cases"][0]["heldout_over_noise"], 0.15);
  EXPECT_TRUE(std::filesystem::exists(folder.file("proof/case_001/fresh/trial_2.csv")));
  EXPECT_TRUE(proof["cases"][2]["heldout_over_noise"].is_null());
  EXPECT_NE(std::string::npos, readFile(folder.file("proof/proof.html")).find("NOT MET"));
  // Its folder and the file of its cases are counted alike; no case is counted twice.
  const std::string lines = folder.file("cases.jsonl");
  writeFile(lines, linesOf(provedCasesIn(request.out)));
  const auto again = provedCasesIn(lines);
  EXPECT_EQ(proofJson(score(cases), cases), proofJson(score(again), again));
  EXPECT_THROW(provedCasesIn({request.out, lines}), InputError);
  // Another trial does not fit in.
  request.seed = 4;
  EXPECT_THROW(runProof(request, {}, broken, stop), InputError);
}

// A leg whose joint was drawn so stiff that the other engine could not simulate it took the count of all others with
// it.
TEST(Proof, ACaseThatCannotBeMadeIsNamedAndTheOthersCount) {
  const TemporaryFolder folder;
  const std::string generator = folder.file("conceal");
  writeFile(generator, std::string("#!/bin/sh\ncase \"$*\" in *\"--case 1 \"*) exit 1;; esac\nexec \"") +
                           CONCEAL_PROGRAM + "\" \"$@\"\n");
  std::filesystem::permissions(generator, std::filesystem::perms::owner_all);
  const ProofRequest request = twoFlights(generator, folder);
  const std::atomic<bool> stop{false};
  try {
    runProof(request, {}, contentAnalyst, stop);
    ADD_FAILURE() << "nothing was said of case 1";
  } catch (const InputError& error) {
    EXPECT_NE(std::string::npos, std::string(error.what()).find("case 1: ")) << error.what();
    EXPECT_EQ(std::string::npos, std::string(error.what()).find("case 2: ")) << error.what();
  }
  const auto proof = nlohmann::json::parse(readFile(folder.file("proof/proof.json")));
  EXPECT_EQ(1, proof["all"]["false_alarms"]["cases"]);
}

// A generator that does not start at all said so once for each of a hundred cases.
TEST(Proof, WhatIsWrongInAllCasesIsSaidOnce) {
  const TemporaryFolder folder;
  const std::string generator = folder.file("conceal");
  writeFile(generator, "#!/bin/sh\necho a library is missing >&2\nexit 1\n");
  std::filesystem::permissions(generator, std::filesystem::perms::owner_all);
  ProofRequest request = twoFlights(generator, folder);
  request.cases = 7;
  const std::atomic<bool> stop{false};
  const std::string said = test::refusal([&] { runProof(request, {}, contentAnalyst, stop); });
  EXPECT_TRUE(said.starts_with("cases 1, 2, 3, 4, 5 and 2 more: ")) << said;
  EXPECT_EQ(said.find("a library is missing"), said.rfind("a library is missing")) << said;
  EXPECT_NE(std::string::npos, said.find("; the 0 of 7 that are finished")) << said;
}

}  // namespace
}  // namespace btr::prove
