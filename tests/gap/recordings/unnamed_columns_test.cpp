// Tables without a heading, without a time, and trials whose channels stand in several files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/table/table_preview.h"
#include "core/spec/random.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

Recording readWith(const std::string& json, const std::string& text, const std::string& name = "log.txt") {
  const TemporaryFolder folder;
  const Mapping mapping = mappingFromJson(json, "m.json");
  return loadRecording(folder.write(name, text), &mapping);
}

const char* const twoColumns =
    R"({"time_s": {"column": 1, "scale": 0.001}, "leg.hip.position_rad": {"column": 3, "scale": 0.5, "offset": 1}})";

TEST(UnnamedColumns, AreReadByTheirNumbersHoweverTheyAreSeparated) {
  for (const char* text : {"0,7,2\n1,8,4\n2,9,-6\n", "0;7;2\n1;8;4\n2;9;-6\n", "0\t7\t2\n1\t8\t4\n2\t9\t-6\n",
                           "  0   7  2.0\n  1   8  4e0\n  2   9 -6\n", "0,0;7;2,0\n1,0;8;4,0\n2,0;9;-6,0\n",
                           "# rig 3\n0,7,2\n# later\n1,8,4\n\n2,9,-6\n", "0,7,2,\n1,8,4,\n2,9,-6,\n"}) {
    SCOPED_TRACE(text);
    const Recording read = readWith(twoColumns, text);
    EXPECT_THAT(read.columns[0], ElementsAre(0, 0.001, 0.002));
    EXPECT_THAT(read.columns[static_cast<std::size_t>(read.column("leg.hip.position_rad"))], ElementsAre(2, 3, -2));
    EXPECT_THAT(read.notes, Contains(HasSubstr("no heading: its 3 columns, from line ")));
  }
}

TEST(UnnamedColumns, BeginBehindAPreambleOfWordsAndNumbers) {
  const Recording read =
      readWith(R"({"time_s": {"period_s": 0.001}, "rod.hinge.position_rad": {"column": 1}})",
               "trigger_start_deg, sample_rate, duration_sec\n90, 1000, 5 \n-1.5\n-1.25\n-1\n-0.5\n");
  EXPECT_THAT(read.columns[0], ElementsAre(0, 0.001, 0.002, 0.003));
  EXPECT_THAT(read.columns[1], ElementsAre(-1.5, -1.25, -1, -0.5));
  EXPECT_THAT(read.notes, Contains(HasSubstr("no column has the time: a row every 0.001 s")));
}

TEST(UnnamedColumns, KeepTheHeadingThatIsThere) {
  const Recording read = readWith(twoColumns, "ms,pwm,deg\n0,7,2\n1,8,4\n2,9,-6\n");
  EXPECT_THAT(read.columns[static_cast<std::size_t>(read.column("leg.hip.position_rad"))], ElementsAre(2, 3, -2));
  EXPECT_THAT(read.channels, ElementsAre("time_s", "pwm", "leg.hip.position_rad"));
  const Recording mixed = readWith(R"({"time_s": {"column": 1}, "leg.hip.position_rad": {"column": "deg"}})",
                                   "ms,pwm,deg\n0,7,2\n1,8,4\n2,9,-6\n");
  EXPECT_THAT(mixed.columns[static_cast<std::size_t>(mixed.column("leg.hip.position_rad"))], ElementsAre(2, 4, -6));
}

TEST(UnnamedColumns, CountTheTimeOfATableWithNames) {
  const Recording read = readWith(R"({"time_s": {"period_s": 0.02}, "leg.hip.position_rad": {"column": "deg"}})",
                                  "Rig 3\npwm,deg\n7,2\n8,4\n9,-6\n");
  EXPECT_THAT(read.columns[0], ElementsAre(0, 0.02, 0.04));
}

TEST(UnnamedColumns, HideNoRowThatIsOdd) {
  EXPECT_THAT(test::refusal([] { readWith(twoColumns, "0,7,2\n1,8,4\n2,9,-6\n3,9,1,5\n4,9,1\n"); }),
              HasSubstr("line 4: 4 columns is not allowed"));
  EXPECT_THAT(test::refusal([] { readWith(twoColumns, "0,7,2\n1,8,4\n2,9,x\n3,1,5\n"); }),
              HasSubstr("line 3, column 3 (leg.hip.position_rad): \"x\""));
  EXPECT_THAT(test::refusal([] { readWith(twoColumns, "0,7\n1,8\n2,9\n"); }),
              HasSubstr("column \"column 3\" is missing, which m.json maps to leg.hip.position_rad; the file has "
                        "column 1, column 2"));
  EXPECT_THAT(test::refusal([] { mappingFromJson(R"({"time_s": {"column": 0}})", "m.json"); }), HasSubstr("column"));
}

TEST(UnnamedColumns, AreShownBeforeAnyMappingIsWritten) {
  const TemporaryFolder folder;
  const TablePreview preview = previewTable(folder.write("log.csv", "0.5 1 -3\n0.6 2 5\n0.7 3 4\n"));
  ASSERT_EQ(preview.columns.size(), 3u);
  EXPECT_EQ(preview.columns[2].name, "column 3");
  EXPECT_EQ(preview.columns[2].low, -3);
}

/// Whatever numbers stand there: all rows are read, in their order.
TEST(UnnamedColumns, LoseNoRow) {
  Random random(5);
  for (int draw = 0; draw < 200; ++draw) {
    const std::size_t rows = 2 + random.below(40);
    std::string text;
    std::vector<double> written;
    for (std::size_t row = 0; row < rows; ++row) {
      written.push_back(std::round(random.uniform(-9, 9) * 100) / 100);
      text += std::to_string(row) + ",1," + std::to_string(written.back()) + "\n";
    }
    const Recording read = readWith(R"({"time_s": {"column": 1}, "leg.hip.command_rad": {"column": 3}})", text);
    ASSERT_EQ(read.rows(), rows) << text;
    EXPECT_EQ(read.columns[static_cast<std::size_t>(read.column("leg.hip.command_rad"))], written);
  }
}

TEST(OtherTables, AreJoinedWithTheirOwnTimes) {
  const TemporaryFolder folder;
  folder.write("run1_command.csv", "stamp_ns,goal\n1000000000,0.5\n1500000000,0.7\n");
  const std::string path = folder.write("run1_state.csv", "t,q\n1.0,0.1\n1.2,0.2\n1.4,0.3\n1.6,0.4\n");
  const Mapping mapping = mappingFromJson(R"({
    "time_s": {"column": "t"}, "leg.hip.position_rad": {"column": "q"},
    "tables": [{"file": {"replace": "state", "with": "command"},
                "time_s": {"column": "stamp_ns", "scale": 1e-9}, "leg.hip.command_rad": {"column": "goal"}}]})",
                                          "m.json");
  const Recording read = loadRecording(path, &mapping);
  EXPECT_THAT(read.columns[0], ElementsAre(1.0, 1.2, 1.4, 1.5, 1.6));
  const auto& goal = read.columns[static_cast<std::size_t>(read.column("leg.hip.command_rad"))];
  const auto& q = read.columns[static_cast<std::size_t>(read.column("leg.hip.position_rad"))];
  EXPECT_EQ(goal[0], 0.5);
  EXPECT_TRUE(std::isnan(goal[2]));
  EXPECT_EQ(goal[3], 0.7);
  EXPECT_TRUE(std::isnan(q[3]));
  EXPECT_EQ(q[4], 0.4);
  EXPECT_THAT(read.notes, Contains(HasSubstr("joined with run1_command.csv, SHA-256 ")));
}

TEST(OtherTables, WithoutTimesOrNamesAreJoinedRowByRow) {
  const TemporaryFolder folder;
  folder.write("input.csv", "3.5,0\n3.6,0\n3.7,0\n");
  const std::string path = folder.write("trajectory.csv", "0.1 1\n0.2 1\n0.3 1\n");
  const Mapping mapping = mappingFromJson(R"({
    "time_s": {"period_s": 0.004}, "arm.j1.position_rad": {"column": 1},
    "tables": [{"file": "input.csv", "time_s": {"period_s": 0.004}, "arm.j1.torque_nm": {"column": 1}}]})",
                                          "m.json");
  const Recording read = loadRecording(path, &mapping);
  EXPECT_THAT(read.columns[0], ElementsAre(0, 0.004, 0.008));
  EXPECT_THAT(read.columns[static_cast<std::size_t>(read.column("arm.j1.torque_nm"))], ElementsAre(3.5, 3.6, 3.7));
}

TEST(OtherTables, MustBeThereAndTellOneStory) {
  const auto wrong = [](const std::string& other, const std::string& table) {
    const TemporaryFolder folder;
    folder.write("input.csv", other);
    const std::string path = folder.write("log.csv", "t,q\n0,1\n1,2\n2,3\n");
    return test::refusal([&] {
      const Mapping mapping = mappingFromJson(
          R"({"time_s": {"column": "t"}, "leg.hip.position_rad": {"column": "q"}, "tables": [)" + table + "]}",
          "m.json");
      loadRecording(path, &mapping);
    });
  };
  const std::string time = R"("time_s": {"column": "t"})";
  EXPECT_THAT(
      wrong("t,q\n0,1\n1,2\n", R"({"file": "input.csv", )" + time + R"(, "leg.hip.position_rad": {"column": "q"}})"),
      HasSubstr("channel \"leg.hip.position_rad\" again"));
  EXPECT_THAT(wrong("", R"({"file": "other.csv", )" + time + R"(, "leg.hip.duty": {"column": "q"}})"),
              HasSubstr("other.csv: there is no such file"));
  EXPECT_THAT(wrong("", R"({"file": "../x.csv", )" + time + R"(, "leg.hip.duty": {"column": "q"}})"),
              HasSubstr("the name of a file beside the recording"));
  EXPECT_THAT(
      wrong("", R"({"file": {"replace": "state", "with": "cmd"}, )" + time + R"(, "leg.hip.duty": {"column": "q"}})"),
      HasSubstr("a part of the recording's name, log.csv"));
  EXPECT_THAT(wrong("", R"({"file": "input.csv", "leg.hip.duty": {"column": "q"}})"), HasSubstr("\"time_s\""));
  EXPECT_THAT(wrong("t,q\n14:03:01,1\n14:03:02,2\n",
                    R"({"file": "input.csv", )" + time + R"(, "leg.hip.duty": {"column": "q"}})"),
              HasSubstr("times that are dates or times of day"));
}

TEST(OtherFormats, AreSaidToBeNoTable) {
  const TemporaryFolder folder;
  for (const char* json : {"{\"time\": [0, 1]}", "[{\"t\": 0}]", "[[0, 1], [1, 2]]"})
    EXPECT_THAT(test::refusal([&] { loadRecording(folder.write("log.json", json)); }), HasSubstr("this is JSON"));
}

}  // namespace
}  // namespace btr
