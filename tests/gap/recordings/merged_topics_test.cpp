// Several topics in one table: rows of one time, rows of one topic behind those of another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/parameter.h"
#include "core/spec/random.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string head = "time_s,leg.knee.command_rad,leg.knee.position_rad\n";

Recording topics(const std::string& rows, const std::string& mapping = "") {
  const TemporaryFolder folder;
  if (!mapping.empty()) folder.write("log.mapping.json", mapping);
  return loadRecording(folder.write("log.csv", head + rows));
}

std::string topicsRefused(const std::string& rows) {
  return test::refusal([&] { topics(rows); });
}

TEST(MergedTopics, RowsOfOneTimeThatComplementEachOtherAreOne) {
  const Recording read = topics("0,1,\n0,,5\n0.1,,6\n0.2,2,\n0.2,,7\n,,\n0.3,3,8\n0.3,3,8\n");
  EXPECT_EQ(read.columns[0], (std::vector<double>{0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(read.columns[2], (std::vector<double>{5, 6, 7, 8}));
  EXPECT_EQ(read.columns[1][0], 1);
  EXPECT_TRUE(std::isnan(read.columns[1][1]));
  EXPECT_EQ(read.columns[1][2], 2);
  EXPECT_THAT(read.notes,
              Contains("3 rows were joined with the one before of the same time: several topics in one table"));
  EXPECT_THAT(read.at(2, 1), HasSubstr("line 4,"));
}

TEST(MergedTopics, ContradictionsAreAnErrorWithBothLines) {
  EXPECT_THAT(topicsRefused("0,1,5\n0.1,1,\n0.1,2,\n"),
              AllOf(HasSubstr("log.csv line 4, column 2 (leg.knee.command_rad): 2 at 0.1 s is not allowed"),
                    HasSubstr("line 3 has 1 for the same time")));
  // Not only of neighbours.
  EXPECT_THAT(topicsRefused("0,1,\n0,,5\n0,7,\n"), AllOf(HasSubstr("line 4, column 2"), HasSubstr("line 2 has 1")));
}

TEST(MergedTopics, OneTopicBehindAnotherIsPutInOrder) {
  const Recording read = topics("0,1,\n0.2,2,\n0.4,3,\n0.1,,5\n0.2,,6\n0.3,,7\n");
  EXPECT_EQ(read.columns[0], (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(read.columns[2][2], 6);
  EXPECT_EQ(read.columns[1][2], 2);
  EXPECT_THAT(read.notes, Contains("rows of several topics were put in the order of time"));
  // A clock that runs back within a topic is none of that.
  EXPECT_THAT(topicsRefused("0,1,\n0.2,2,\n0.1,,5\n0.3,,6\n0.2,,7\n"),
              HasSubstr("line 6, column 1 (time_s): 0.2 is not allowed; times that increase"));
  EXPECT_THAT(topicsRefused("0,1,5\n0.1,2,6\n0.2,2,6\n0.3,2,6\n0,1,5\n0.1,2,6\n"),
              HasSubstr("line 6, column 1 (time_s): 0 is not allowed; times that increase from row to row; before it "
                        "stands 0.3; a second recording begins there"));
}

TEST(MergedTopics, ARecordingBeginsWhereItsCommandsDo) {
  const Recording read = topics("0,,5\n0.1,,6\n0.1,1,\n0.2,,7\n0.3,2,\n0.3,,8\n");
  EXPECT_EQ(read.columns[0], (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_THAT(read.notes, Contains("1 row before the first value of leg.knee.command_rad left out"));
}

// Exported topics rarely share their stamps.
TEST(MergedTopics, WhoseTimesAllDifferBeginWhereTheLastCommandDoes) {
  const TemporaryFolder folder;
  const Recording read =
      loadRecording(folder.write("log.csv",
                                 "time_s,leg.knee.command_rad,leg.hip.command_rad,leg.knee.position_rad\n"
                                 "0,,,5\n0.1,1,,\n0.15,2,,\n0.2,,,6\n0.3,,7,\n0.4,,,8\n0.5,3,,\n"));
  EXPECT_EQ(read.columns[0], (std::vector<double>{0.3, 0.4, 0.5}));
  EXPECT_EQ(read.columns[1][0], 2) << "the command that held by then";
  EXPECT_EQ(read.columns[2][0], 7);
  EXPECT_TRUE(std::isnan(read.columns[3][0]));
  EXPECT_THAT(read.notes, Contains("4 rows before the first value of leg.hip.command_rad left out"));
  EXPECT_THAT(read.at(3, 1), HasSubstr("line 7,"));
}

/// Topics at any rates, split, merged and shuffled as blocks, are what they were before.
TEST(MergedTopics, AreTheirTopicsHoweverTheyWereMerged) {
  Random random(5);
  for (int draw = 0; draw < 50; ++draw) {
    const int commandEvery = 1 + static_cast<int>(random.below(4)),
              positionEvery = 1 + static_cast<int>(random.below(4));
    std::vector<std::string> commands, positions;
    std::vector<double> wantedPositions;
    for (int i = 0; i < 60; ++i) {
      const std::string time = toText(0.005 * i);
      if (i % commandEvery == 0) commands.push_back(time + "," + toText(0.1 * i) + ",\n");
      if (i % positionEvery != 0) continue;
      wantedPositions.push_back(random.uniform());
      positions.push_back(time + ",," + toText(wantedPositions.back()) + "\n");
    }
    std::string rows;
    std::size_t c = 0, p = 0;
    while (c < commands.size() || p < positions.size())
      rows += p == positions.size() || (c < commands.size() && random.chance(0.5)) ? commands[c++] : positions[p++];
    const Recording read = topics(rows);
    std::vector<double> found;
    for (std::size_t row = 0; row < read.rows(); ++row) {
      if (row > 0) {
        EXPECT_GT(read.columns[0][row], read.columns[0][row - 1]);
      }
      if (std::isfinite(read.columns[2][row])) found.push_back(read.columns[2][row]);
    }
    EXPECT_EQ(found, wantedPositions) << draw;
  }
}

TEST(MergedTopics, AreNoPausesAndNoEmptyCells) {
  // Commands at 100 Hz and positions at 200 Hz, by two clocks.
  std::string rows;
  for (int i = 0; i < 400; ++i) {
    if (i % 2 == 0) rows += toText(0.005 * i + 0.0007) + "," + toText(0.01 * i) + ",\n";
    rows += toText(0.005 * i + 0.001) + ",," + toText(0.01 * i) + "\n";
  }
  const RecordingHealth health = examine(topics(rows));
  EXPECT_NEAR(health.period_s, 0.005, 1e-9);
  EXPECT_THAT(health.gaps, IsEmpty());
  EXPECT_THAT(topics(rows).thinned, IsEmpty());
}

TEST(MergedTopics, AValueInEveryOtherRowIsASlowerSensor) {
  std::string rows;
  for (int i = 0; i < 100; ++i) rows += toText(0.005 * i) + ",0," + (i % 2 == 0 ? toText(0.01 * i) : "") + "\n";
  const Recording read = topics(rows);
  EXPECT_THAT(read.notes, IsEmpty());
  EXPECT_THAT(examine(read).findings, Contains("leg.knee.position_rad: a value in every 2nd row; compared there"));
}

}  // namespace
}  // namespace btr
