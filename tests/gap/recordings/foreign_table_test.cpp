// Tables as other programs write them: the same numbers, however they are written down.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/table/table_preview.h"
#include "core/gap/recordings/table/time_stamp.h"
#include "core/spec/sha256.h"
#include "tests/gap/recordings/foreign_table.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

/// Four columns of sixty rows, six decimals each; the last has empty cells.
std::vector<std::vector<double>> numbersToWrite(Random& random) {
  std::vector<std::vector<double>> columns(4);
  for (int i = 0; i < 60; ++i) {
    columns[0].push_back(std::round((0.01 * i + random.uniform(0, 0.004)) * 1e6) / 1e6);
    for (int c = 1; c < 4; ++c) columns[std::size_t(c)].push_back(std::round(random.uniform(-3, 3) * 1e6) / 1e6);
    if (i % 7 == 3) columns[3].back() = std::nan("");
  }
  return columns;
}

Mapping mappingOfTable(const std::vector<std::string>& names) {
  Mapping mapping;
  mapping.source = "m.json";
  const char* channels[] = {"time_s", "leg.hip.position_rad", "leg.knee.position_rad", "leg.foot.velocity_rad_s"};
  for (std::size_t i = 0; i < 4; ++i) {
    MappedColumn column;
    column.channel = channels[i];
    column.column = names[i];
    mapping.columns.push_back(column);
  }
  return mapping;
}

Recording readText(const std::string& text, const Mapping* mapping = nullptr) {
  const TemporaryFolder folder;
  return loadRecording(folder.write("log.csv", text), mapping);
}

std::string refusalOfText(const std::string& text, const Mapping* mapping = nullptr) {
  return test::refusal([&] { readText(text, mapping); });
}

TEST(ForeignTable, HoldsTheSameNumbersHoweverItIsWritten) {
  Random random(38);
  for (int draw = 0; draw < 400; ++draw) {
    const auto numbers = numbersToWrite(random);
    const ForeignTable table = drawnTable(random, numbers);
    const Mapping mapping = mappingOfTable(table.names);
    const std::string text = table.text();
    SCOPED_TRACE(std::to_string(draw) + ": " + text.substr(0, 200));
    const Recording read = readText(text, &mapping);
    ASSERT_EQ(read.rows(), numbers[0].size());
    EXPECT_EQ(read.sha256, sha256(text));
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t row = 0; row < read.rows(); ++row) {
        const int column = read.column(mapping.columns[c].channel);
        const double value = read.columns[static_cast<std::size_t>(column)][row];
        const double wanted = numbers[c][row] - (c == 0 && table.isoTime ? numbers[0][0] : 0);
        if (std::isnan(wanted))
          ASSERT_TRUE(std::isnan(value));
        else
          ASSERT_NEAR(value, wanted, c == 0 && table.isoTime ? 1e-9 : 0) << c << " " << row;
      }
  }
}

TEST(ForeignTable, SaysWhatWasPassedOver) {
  const Recording read = readText(
      "Rig 3, May\n\ntime_s,ball.x_m,ball.y_m\ns,m,m\n0,1,2\n# a pause\n1,2,\n,,\ntime_s,ball.x_m,ball.y_m\n2,3,1\n");
  EXPECT_EQ(read.rows(), 3u);
  EXPECT_THAT(read.notes, AllOf(Contains("the heading stands in line 3; the lines above it were passed over"),
                                Contains(HasSubstr("line 4 holds words or units (s, m, m), passed over")),
                                Contains("1 line of comment passed over"),
                                Contains("1 row without anything passed over, the first in line 8"),
                                Contains("the heading stands again in line 9; passed over")));
  EXPECT_THAT(read.at(1, 2), testing::EndsWith("log.csv line 10, column 2 (ball.x_m)"));
}

TEST(ForeignTable, KeepsOneDecimalMark) {
  EXPECT_THAT(
      refusalOfText("time_s;ball.x_m\n0,1;1\n0,2;1.5\n"),
      HasSubstr("line 3, column 2 (ball.x_m): \"1.5\" is not allowed; a finite number or an empty cell (decimals "
                "after a comma, as in line 2, and nothing between thousands)"));
  EXPECT_THAT(refusalOfText("time_s;ball.x_m\n0.1;1\n0.2;1,500\n"),
              HasSubstr("(decimals after a point, as in line 2, and nothing between thousands)"));
  EXPECT_THAT(refusalOfText("time_s;ball.x_m\n0;1.234,5\n"), HasSubstr("line 2, column 2 (ball.x_m): \"1.234,5\""));
  EXPECT_THAT(refusalOfText("time_s;ball.x_m\n0;1,234,567\n"), HasSubstr("\"1,234,567\""));
  EXPECT_THAT(refusalOfText("time_s,ball.x_m\n0,000,1,5\n"),
              HasSubstr("line 2: 4 columns is not allowed; as many as the header has, 2 (commas as decimals need "
                        "semicolons between the columns"));
}

TEST(ForeignTable, LeavesAColumnThatNothingReadsItsNameTwice) {
  const Recording read = readText(",time_s,load,load,ball.x_m\n0,0.5,3,4,1\n1,0.6,5,6,2\n");
  EXPECT_EQ(read.channels, (std::vector<std::string>{"time_s", "column 1", "load", "load (column 4)", "ball.x_m"}));
  EXPECT_EQ(read.columns[3], (std::vector<double>{4, 6}));
  EXPECT_THAT(refusalOfText("time_s,ball.x_m,ball.x_m\n0,1,1\n"), HasSubstr("line 1, column 3: \"ball.x_m\" again"));
}

TEST(ForeignTable, LeavesALastLineOutThatWasCutOff) {
  const Recording read = readText("time_s,ball.x_m,ball.y_m\n0,1,2\n1,2,3\n2,4");
  EXPECT_EQ(read.rows(), 2u);
  EXPECT_THAT(read.notes, ElementsAre("the last line, 4, was cut off: 2 columns of 3; left out"));
  EXPECT_THAT(refusalOfText("time_s,ball.x_m,ball.y_m\n0,1,2\n2,4\n1,2,3\n"), HasSubstr("line 3: 2 columns"));
}

TEST(ForeignTable, HasSwitchesInWords) {
  EXPECT_EQ(readText("time_s,leg.knee.enabled\n0,True\n1,false\n").columns[1], (std::vector<double>{1, 0}));
  EXPECT_THAT(refusalOfText("time_s,leg.knee.duty\n0,True\n"), HasSubstr("line 2, column 2 (leg.knee.duty): \"True\""));
}

TEST(ForeignTable, ShowsItsColumnsBeforeAnyMappingIsWritten) {
  const TemporaryFolder folder;
  const std::string rig =
      "Rig 3\n\nstamp;\"q [deg]\"\ns;deg\n2026-11-27T14:03:01,25Z;-1,5\n2026-11-27T14:03:01,26Z;2,25\n";
  const TablePreview preview = previewTable(folder.write("log.csv", rig));
  ASSERT_EQ(preview.columns.size(), 2u);
  EXPECT_EQ(preview.columns[0].name, "stamp");
  EXPECT_TRUE(std::isnan(preview.columns[0].low));
  EXPECT_EQ(preview.columns[1].name, "q [deg]");
  EXPECT_EQ(preview.columns[1].low, -1.5);
  EXPECT_EQ(preview.columns[1].high, 2.25);
}

TEST(ForeignTable, AsksWhatItsColumnsAre) {
  EXPECT_THAT(refusalOfText("0.0,1.5\n0.1,1.6\n"),
              HasSubstr("log.csv: there is no column time_s; the file has column 1, column 2; a mapping "
                        "(NAME.mapping.json beside it) says which column is what, here by numbers"));
  EXPECT_THAT(refusalOfText("Rig 3\n\nt;q\n0,5;1\n1,5;2\n"), HasSubstr("no column time_s; the file has t, q"));
}

TEST(TimeStamp, IsReadAsIso8601Has) {
  const auto second = [](const char* text) {
    const auto stamp = readTimeStamp(text);
    return stamp ? static_cast<double>(stamp->second) + stamp->fraction : -1;
  };
  EXPECT_EQ(second("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(second("2001-09-09T01:46:40Z"), 1e9);
  EXPECT_EQ(second("2001-09-09 03:46:40.25+02:00"), 1e9 + 0.25);
  EXPECT_EQ(second("2001-09-08T22:16:40,5-0330"), 1e9 + 0.5);
  EXPECT_EQ(second("09.09.2001 01:46:40"), 1e9);
  EXPECT_EQ(second("14:03:01.5"), 14 * 3600 + 3 * 60 + 1.5);
  for (const char* wrong : {"", "2001-02-30T00:00:00", "2001-13-01T00:00:00", "24:00:00", "12:60:00", "2001-09-09",
                            "2001-09-09T01:46", "2001-09-09T01:46:40.", "2001-09-09T01:46:40Zulu", "1.5", "12:00:00x"})
    EXPECT_FALSE(readTimeStamp(wrong)) << wrong;
}

TEST(TimeStamp, CountsSecondsFromTheFirstRow) {
  const Recording read =
      readText("time_s,ball.x_m\n2024-02-28T23:59:59.990,1\n2024-02-29T00:00:00.000,2\n2024-02-29T00:00:00.010,3\n");
  EXPECT_NEAR(read.columns[0][2], 0.02, 1e-12);
  EXPECT_THAT(read.notes, ElementsAre("time_s holds time stamps; 0 s is \"2024-02-28T23:59:59.990\", read as UTC"));
  // A clock without a date passes midnight.
  EXPECT_NEAR(readText("time_s,ball.x_m\n23:59:59.990,1\n00:00:00.000,2\n").columns[0][1], 0.01, 1e-9);
}

TEST(TimeStamp, SeesTheEndOfSummerTime) {
  EXPECT_THAT(refusalOfText("time_s,ball.x_m\n2024-10-27T02:59:59.990,1\n2024-10-27T02:00:00.000,2\n"),
              AllOf(HasSubstr("log.csv line 3, column 1 (time_s)"), HasSubstr("the clock was set back by 1 h"),
                    HasSubstr("UTC")));
}

TEST(TimeStamp, HasNoUnitAndStandsInEveryRow) {
  Mapping mapping = mappingOfTable({"t", "a", "b", "c"});
  mapping.columns[0].scale = 0.001;
  EXPECT_THAT(refusalOfText("t,a,b,c\n12:00:00,1,1,1\n", &mapping), HasSubstr("is a time stamp, which has no unit"));
  EXPECT_THAT(refusalOfText("time_s,ball.x_m\n12:00:00,1\n7.5,1\n"), HasSubstr("line 3, column 1 (time_s): \"7.5\""));
  EXPECT_THAT(refusalOfText("time_s,ball.x_m\n7.5,1\n12:00:00,1\n"),
              HasSubstr("line 3, column 1 (time_s): \"12:00:00\""));
}

TEST(TimeStamp, NamesMillisecondsSince1970) {
  EXPECT_THAT(refusalOfText("time_s,ball.x_m\n1730000000000,1\n1730000000010,2\n"),
              HasSubstr("these are milliseconds since 1970, it seems: \"scale\" 0.001"));
  EXPECT_THAT(refusalOfText("time_s,ball.x_m\n1730000000000000000,1\n"), HasSubstr("nanoseconds since 1970"));
}

}  // namespace
}  // namespace btr
