#include "core/run/reality/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace btr {
namespace {

using testing::HasSubstr;

MeasurementRecord value(double v, bool isVoid = false) {
  MeasurementRecord m;
  m.value = v;
  m.isVoid = isVoid;
  return m;
}

std::vector<MeasurementRecord> values(const std::vector<double>& all) {
  std::vector<MeasurementRecord> records;
  for (const double v : all) records.push_back(value(v));
  return records;
}

/// Kicks in m that the simulator expects, and what was measured already.
KnownFitness kicks(const std::vector<double>& simulated, const std::vector<double>& stored = {}) {
  KnownFitness known;
  for (const double s : simulated) known.tasks.emplace_back().simulatedFitness = s;
  known.measurements = values(stored);
  known.unit = "m";
  known.canBeNegative = false;
  return known;
}

TEST(Plausibility, ASlippedDecimalPointIsAskedAboutBeforeAnythingWasMeasured) {
  const KnownFitness known = kicks({0.35, 0.4, 0.45});
  EXPECT_TRUE(doubts(known, values({0.38, 0.6, 0.05, 0})).empty());
  for (const double slip : {4.0, 41.0, 410.0, 1e6}) {
    const auto all = doubts(known, values({slip}));
    ASSERT_EQ(1u, all.size()) << slip;
    EXPECT_FALSE(all[0].isImpossible);
  }
  EXPECT_THAT(doubts(known, values({41}))[0].sentence, HasSubstr("41 m is about 100 times larger than is expected"));
  EXPECT_THAT(doubts(known, values({0.004}))[0].sentence, HasSubstr("100 times smaller"));
}

TEST(Plausibility, ASentenceNeverTellsASimulatedValue) {
  const auto all = doubts(kicks({0.321, 0.321}), values({40}));
  ASSERT_EQ(1u, all.size());
  EXPECT_THAT(all[0].sentence, testing::Not(HasSubstr("0.32")));
}

TEST(Plausibility, ATableInAnotherUnitIsAskedAboutLineByLine) {
  EXPECT_EQ(4u, doubts(kicks({0.35, 0.4, 0.45}), values({41, 38, 44, 40})).size());
}

TEST(Plausibility, AValueIsComparedWithWhatWasMeasured) {
  const auto all = doubts(kicks({0.4}, {0.40, 0.42, 0.44}), values({41}));
  ASSERT_EQ(1u, all.size());
  EXPECT_EQ("41 m is about 100 times larger than usual in this run (0.42 m): is the decimal point right, and the unit?",
            all[0].sentence);
  // Simulated 0.02 m, but the real ones lie around 0.5 m.
  EXPECT_TRUE(doubts(kicks({0.02}, {0.5, 0.52}), values({0.55})).empty());
}

TEST(Plausibility, FarFromTheOthersMeansManyRobustDeviationsNotTheMean) {
  // Median 1.0, 1.4826·MAD = 0.15 < the least spread 0.2: beyond 1.0 + 8·0.2 is far.
  const KnownFitness known = kicks({1, 1, 1}, {0.9, 0.9, 1.0, 1.1, 1.1});
  EXPECT_TRUE(doubts(known, values({2.59})).empty());
  const auto far = doubts(known, values({2.61}));
  ASSERT_EQ(1u, far.size());
  EXPECT_EQ("2.61 m is far from the other measured values (0.9 to 1.1 m)", far[0].sentence);
  // Three values are not enough to say what is far.
  EXPECT_TRUE(doubts(kicks({1, 1, 1}, {0.9, 1.0, 1.1}), values({2.61})).empty());
}

TEST(Plausibility, AnOutlierIsFoundAmongTheValuesThatAreEnteredWithIt) {
  const auto all = doubts(kicks({1, 1}), values({1, 1.1, 0.9, 1, 2.9}));
  ASSERT_EQ(1u, all.size());
  EXPECT_EQ(4u, all[0].index);
}

TEST(Plausibility, ANegativeDistanceIsImpossibleAndANegativeSpeedIsNot) {
  KnownFitness known = kicks({0.4});
  const auto all = doubts(known, values({-0.5}));
  ASSERT_EQ(1u, all.size());
  EXPECT_TRUE(all[0].isImpossible);
  EXPECT_THAT(all[0].sentence, HasSubstr("-0.5 m is not possible"));
  known.canBeNegative = true;
  EXPECT_TRUE(doubts(known, values({-0.5})).empty());
}

TEST(Plausibility, VoidValuesAreNeitherJudgedNorCompared) {
  KnownFitness known = kicks({0.4});
  known.measurements = {value(41, true)};
  EXPECT_TRUE(doubts(known, {value(-9, true), value(410, true)}).empty());
  EXPECT_EQ(1u, doubts(known, values({41})).size());
}

TEST(Plausibility, ARunWithoutAnyExpectationAsksNothing) { EXPECT_TRUE(doubts(kicks({0, 0}), values({0.3})).empty()); }

TEST(Plausibility, RealKicksOfAFinishedRunRaiseNoDoubt) {
  // Three stages of a kick as a stand-in answered them: simulated and real differ, none is a slip.
  const std::vector<std::pair<double, double>> stages[] = {
      {{0.255, 0.217}, {0.282, 0.207}, {0.584, 0.491}, {0.229, 0.145}, {0.626, 0.919}},
      {{0.631, 0.226}, {0.619, 0.741}, {0.773, 0.682}, {0.510, 0.114}, {0.916, 0.906}},
      {{0.945, 0.789}, {0.997, 0.906}, {1.034, 1.025}, {1.021, 0.996}, {1.002, 0.452}}};
  KnownFitness known = kicks({});
  for (const auto& stage : stages) {
    for (const auto& [simulated, real] : stage) known.tasks.emplace_back().simulatedFitness = simulated;
    for (const auto& [simulated, real] : stage) {
      EXPECT_TRUE(doubts(known, values({real})).empty()) << real;
      known.measurements.push_back(value(real));
    }
  }
}

TEST(Plausibility, ConfirmingADoubtLetsTheValueCountAndAnImpossibleOneNever) {
  const std::vector<Doubt> doubtful = doubts(kicks({0.4}), values({0.4, 41}));
  EXPECT_EQ("", whyRefused({}, false, "say so"));
  EXPECT_EQ("", whyRefused(doubtful, true, "say so"));
  const std::string said = whyRefused(doubtful, false, "say so", {"line 2", "line 3"});
  EXPECT_TRUE(said.starts_with("line 3: 41 m is about")) << said;
  EXPECT_TRUE(said.ends_with("; nothing was stored; say so")) << said;

  const std::vector<Doubt> both = doubts(kicks({0.4}), values({-1, 41}));
  EXPECT_EQ("-1 m is not possible: this fitness is never negative", whyRefused(both, true, "say so"));
  EXPECT_THAT(whyRefused(both, false, "say so"), testing::Not(HasSubstr("say so")));
}

}  // namespace
}  // namespace btr
