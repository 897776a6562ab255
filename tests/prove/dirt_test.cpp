// What loggers do to recordings.
#include "tests/prove/dirt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"
#include "tests/prove/prove_fixture.h"
#include "tests/temporary_folder.h"

namespace btr::prove {
namespace {

constexpr double period = 0.01;

/// A command and two sensors, of which the second has two columns; cells say their row.
LoggedTrial clean(std::size_t rows = 1000) {
  LoggedTrial trial;
  trial.columns = {"time_s", "arm.hinge.command_rad", "arm.hinge.position_rad", "ball.x_m", "ball.y_m"};
  trial.firstMeasured = 2;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto n = static_cast<double>(row);
    trial.rows.push_back({n * period, n, n, n, n});
  }
  return trial;
}

TEST(DirtOfLoggers, QuietIsAsItWas) {
  LoggedTrial trial = clean();
  soil(trial, drawDirt("quiet", {0, 1, 1}, true, Random(1)), period, Random(2));
  EXPECT_EQ(csvOf(clean()), csvOf(trial));
}

TEST(DirtOfLoggers, JitterMovesStampsAndKeepsTheirOrder) {
  LoggedTrial trial = clean();
  const Dirt dirt = drawDirt("jitter", {0, 1, 1}, true, Random(1));
  soil(trial, dirt, period, Random(2));
  double squares = 0;
  for (std::size_t row = 1; row < trial.rows.size(); ++row) {
    EXPECT_GT(*trial.rows[row][0], *trial.rows[row - 1][0]);
    squares += std::pow(*trial.rows[row][0] - static_cast<double>(row) * period, 2);
    EXPECT_EQ(static_cast<double>(row), *trial.rows[row][2]);
  }
  // A standard deviation of n normal numbers is known to 1/√(2n): five of them.
  const double found = std::sqrt(squares / 999) / period;
  EXPECT_NEAR(dirt.jitter, found, 5 * dirt.jitter / std::sqrt(2 * 999.0));
}

TEST(DirtOfLoggers, StaleValuesAreThoseOfEarlierRowsAndTogetherInOneSensor) {
  LoggedTrial trial = clean();
  const Dirt dirt = drawDirt("stale", {0, 1, 1}, true, Random(4));
  soil(trial, dirt, period, Random(2));
  ASSERT_EQ(dirt.staleFor[1], dirt.staleFor[2]);
  ASSERT_GT(std::max(dirt.staleFor[0], dirt.staleFor[1]), 1);
  for (std::size_t row = 0; row < trial.rows.size(); ++row) {
    EXPECT_EQ(static_cast<double>(row), *trial.rows[row][1]);  // commands are not measured
    for (std::size_t i = 0; i < 3; ++i) {
      const auto nth = static_cast<std::size_t>(dirt.staleFor[i]);
      EXPECT_EQ(static_cast<double>(row / nth * nth), *trial.rows[row][2 + i]);
    }
  }
}

TEST(DirtOfLoggers, ColumnsOfOtherRatesHaveEmptyCells) {
  LoggedTrial trial = clean();
  const Dirt dirt = drawDirt("multirate", {0, 1, 1}, true, Random(4));
  soil(trial, dirt, period, Random(2));
  for (std::size_t row = 0; row < trial.rows.size(); ++row)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(row % static_cast<std::size_t>(dirt.everyNth[i]) == 0, trial.rows[row][2 + i].has_value());
}

TEST(DirtOfLoggers, LosesAboutAsManyRowsAsWereDrawn) {
  for (const bool hasInputs : {true, false}) {
    LoggedTrial trial = clean(20000);
    const Dirt dirt = drawDirt("dropped", {0, 1, 1}, hasInputs, Random(4));
    soil(trial, dirt, period, Random(2));
    std::size_t lost = 20000 - trial.rows.size();
    for (const auto& row : trial.rows) {
      EXPECT_TRUE(row[1].has_value());
      if (!row[2]) ++lost;
    }
    EXPECT_NEAR(dirt.lost, static_cast<double>(lost) / 20000, 0.25 * dirt.lost);
    EXPECT_EQ(hasInputs, trial.rows.size() == 20000);
  }
}

TEST(DirtOfLoggers, OfAnotherNameIsRefused) { EXPECT_THROW(drawDirt("mud", {0}, true, Random(1)), InputError); }

TEST(Spoiling, MovesOneColumnFromSomeRowOn) {
  LoggedTrial trial = clean();
  spoil(trial, {0.1, 0.1, 0.1}, Random(5));
  int moved = 0;
  for (std::size_t column = 2; column < 5; ++column) {
    EXPECT_EQ(0, *trial.rows[0][column]);
    const double off = std::abs(*trial.rows.back()[column] - 999);
    if (off == 0) continue;
    ++moved;
    EXPECT_GE(off, 1.4);  // 15 noise floors, or nearly, where it drifts
    EXPECT_LE(off, 6.0);
  }
  EXPECT_EQ(1, moved);
}

TEST(Spoiling, IsNamedInTheAnswerAndLeavesTheOtherTrialsAlone) {
  const Plugins plugins;
  const CaseRequest request{.seed = 41, .number = 3, .scene = "flight", .kind = "nothing"};
  CaseRequest dirty = request;
  dirty.spoiled = 2;
  const BlindCase good = drawCase(request, plugins.library), bad = drawCase(dirty, plugins.library);
  const auto before = recordTrials(good, plugins.library), after = recordTrials(bad, plugins.library);
  ASSERT_EQ(before.size(), after.size());
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != after[i]) changed.push_back("trial_" + std::to_string(i + 1) + ".csv");
  EXPECT_EQ(bad.answer.spoiled, changed);
  EXPECT_EQ(2u, changed.size());
}

}  // namespace
}  // namespace btr::prove
