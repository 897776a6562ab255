#include "core/gap/recordings/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/mapping.h"
#include "core/spec/error.h"
#include "core/spec/sha256.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Strings = std::vector<std::string>;
using Numbers = std::vector<double>;

Recording recordingOf(const std::string& csv, const Mapping* mapping = nullptr) {
  const TemporaryFolder folder;
  return loadRecording(folder.write("trial.csv", csv), mapping);
}

std::string refusalOf(const std::string& csv, const Mapping* mapping = nullptr) {
  return test::refusal([&] { recordingOf(csv, mapping); });
}

Mapping mappingOf(const std::string& json) { return mappingFromJson(json, "m.json"); }

std::string mappingRefusal(const std::string& json) {
  return test::refusal([&] { mappingOf(json); });
}

TEST(Recording, ReadsContractColumnsWithTimeFirstAndEmptyCellsAsNotANumber) {
  const std::string csv = "leg.knee.position_rad,time_s,leg.knee.command_rad\n0.5,0,1\n,0.1, +2 \n-1e-3,0.25,3\n";
  const Recording trial = recordingOf(csv);
  EXPECT_EQ(trial.channels, (Strings{"time_s", "leg.knee.position_rad", "leg.knee.command_rad"}));
  ASSERT_EQ(trial.rows(), 3u);
  EXPECT_EQ(trial.columns[0], (Numbers{0, 0.1, 0.25}));
  EXPECT_EQ(trial.columns[2], (Numbers{1, 2, 3}));
  EXPECT_EQ(trial.columns[1][0], 0.5);
  EXPECT_TRUE(std::isnan(trial.columns[1][1]));
  EXPECT_EQ(trial.columns[1][2], -1e-3);
  EXPECT_THAT(trial.notes, ElementsAre("1 of 3 cells of \"leg.knee.position_rad\" are empty"));
  EXPECT_EQ(trial.column("leg.knee.command_rad"), 2);
  EXPECT_EQ(trial.column("leg.hip.command_rad"), -1);
  EXPECT_EQ(trial.sha256, sha256(csv));
}

TEST(Recording, AcceptsByteOrderMarkCarriageReturnsAndQuotedHeaders) {
  const Recording trial = recordingOf("\xEF\xBB\xBF\"time_s\",\"ball.x_m\"\r\n0,1\r\n1,2");
  EXPECT_EQ(trial.channels, (Strings{"time_s", "ball.x_m"}));
  EXPECT_EQ(trial.columns[1], (Numbers{1, 2}));
}

TEST(Recording, KeepsUnmappedColumnsEvenWithTextAndSaysSo) {
  const Recording trial = recordingOf("time_s,phase,leg.base.qw\n0,walk,1\n1,4,1\n");
  EXPECT_EQ(trial.channels[1], "phase");
  EXPECT_TRUE(std::isnan(trial.columns[1][0]));
  EXPECT_EQ(trial.columns[1][1], 4);
  EXPECT_THAT(trial.notes, ElementsAre("column \"phase\" is not mapped to a channel; kept, not used",
                                       "1 of 2 cells of \"phase\" are not numbers; left out"));
}

TEST(Recording, MapsNamesScalesSignsAndOffsets) {
  const Mapping mapping = mappingOf(R"({"time_s": {"column": "t", "scale": 0.001},
    "leg.knee.position_rad": {"column": "q3", "scale": -0.5, "offset": 0.25},
    "leg.knee.command_rad": {"column": "q3"}})");
  const Recording trial = recordingOf("q3,t\n1,0\n-3,500\n", &mapping);
  ASSERT_EQ(trial.channels.size(), 3u);
  EXPECT_EQ(trial.columns[0], (Numbers{0, 0.5}));
  EXPECT_EQ(trial.columns[static_cast<std::size_t>(trial.column("leg.knee.position_rad"))], (Numbers{-0.25, 1.75}));
  EXPECT_EQ(trial.columns[static_cast<std::size_t>(trial.column("leg.knee.command_rad"))], (Numbers{1, -3}));
}

TEST(Recording, FindsTheMappingBesideItBeforeThatOfTheFolder) {
  const TemporaryFolder folder;
  const std::string path = folder.write("trial.csv", "t,q\n0,1\n1,1\n");
  EXPECT_FALSE(findMapping(path));
  folder.write("mapping.json", R"({"time_s": {"column": "t"}, "a.b.position_rad": {"column": "q"}})");
  EXPECT_EQ(loadRecording(path).channels[1], "a.b.position_rad");
  folder.write("trial.csv.mapping.json", R"({"time_s": {"column": "t"}, "c.d.position_m": {"column": "q"}})");
  EXPECT_EQ(loadRecording(path).channels[1], "c.d.position_m");
  folder.write("trial.mapping.json", R"({"time_s": {"column": "t"}, "ball.x_m": {"column": "q"}})");
  EXPECT_EQ(loadRecording(path).channels[1], "ball.x_m");
}

TEST(Recording, TakesTheSettingsOfATrialFromItsName) {
  const Mapping mapping = mappingOf(R"({"time_s": {"column": "time_s"}, "settings": [
    {"file_contains": "tri", "values": {"robots.leg.servos.knee.p": 3, "floor.friction": 1}},
    {"file_contains": "trial", "values": {"robots.leg.servos.knee.p": 4}},
    {"file_contains": "other", "values": {"robots.leg.servos.knee.p": 5}}]})");
  EXPECT_EQ(recordingOf("time_s\n0\n1\n", &mapping).settings,
            (Values{{"robots.leg.servos.knee.p", 4}, {"floor.friction", 1}}));
}

TEST(Recording, NamesLineAndColumnOfWhatIsNotANumber) {
  const std::string head = "time_s,leg.knee.position_rad\n0,1\n";
  for (const std::string cell : {"inf", "-inf", "1e999", "abc", "1.2.3", "0x10", "1 2", "--1", "+-1", "\"1,5\""})
    EXPECT_THAT(refusalOf(head + "0.1," + cell + "\n"),
                HasSubstr("trial.csv line 3, column 2 (leg.knee.position_rad): \""))
        << cell;
  EXPECT_THAT(refusalOf(head + "0.1,\"1,5\"\n"), HasSubstr("decimals after a point"));
  EXPECT_THAT(refusalOf(head + "x,1\n"), HasSubstr("line 3, column 1 (time_s): \"x\" is not allowed"));
  EXPECT_THAT(refusalOf(head + ",1\n"), HasSubstr("line 3, column 1 (time_s): an empty cell"));
  EXPECT_THAT(refusalOf(head + "1," + std::string(100, '9') + "x\n"), HasSubstr(std::string(40, '9') + "...\""));
}

TEST(Recording, ReadsWordsForWhatIsMissingAsEmptyCells) {
  const Recording recording =
      recordingOf("time_s,ball.x_m\n0,1\n0.1,nan\n0.2,NaN\n0.3,NA\n0.4,null\n0.5,None\n0.6,-\n0.7,2\n");
  ASSERT_EQ(8u, recording.rows());
  for (std::size_t row = 1; row < 7; ++row) EXPECT_TRUE(std::isnan(recording.columns[1][row])) << row;
  EXPECT_THAT(recording.notes, Contains(HasSubstr("6 of 8 cells of \"ball.x_m\" say that there is no number")));
  EXPECT_THAT(refusalOf("time_s,ball.x_m\n0,1\nnan,2\n"), HasSubstr("line 3, column 1 (time_s): \"nan\""));
  for (const std::string word : {"#N/A", "#DIV/0!", "#VALUE!", "#NUM!", "#REF!", "NULL"}) {
    const Recording sheet = recordingOf("time_s,ball.x_m\n0,1\n0.1," + word + "\n0.2,2\n");
    ASSERT_EQ(3u, sheet.rows()) << word;
    EXPECT_TRUE(std::isnan(sheet.columns[1][1])) << word;
    EXPECT_THAT(sheet.notes, Contains(HasSubstr("1 of 3 cells of \"ball.x_m\" say that there is no number"))) << word;
  }
}

TEST(Recording, ReadsColumnsThatBlanksSeparate) {
  for (const std::string text : {"time_s ball.x_m ball.y_m\n0 1 2\n0.1 -3 4e-1\n",
                                 "  time_s   ball.x_m\tball.y_m \n   0    1  2\n 0.1\t-3   4e-1\n",
                                 "# made by hand, time_s in seconds\n# time_s ball.x_m ball.y_m\n0 1 2\n0.1 -3 4e-1\n",
                                 "measured on Monday\ntime_s ball.x_m ball.y_m\ns m m\n0 1 2\n0.1 -3 4e-1\n"}) {
    const Recording recording = recordingOf(text);
    EXPECT_EQ((std::vector<std::string>{"time_s", "ball.x_m", "ball.y_m"}), recording.channels) << text;
    EXPECT_EQ((std::vector<double>{0, 0.1}), recording.columns[0]) << text;
    EXPECT_EQ((std::vector<double>{1, -3}), recording.columns[1]) << text;
    EXPECT_EQ((std::vector<double>{2, 0.4}), recording.columns[2]) << text;
  }
  EXPECT_THAT(refusalOf("time_s ball.x_m\n0 1\n0.1 2 3\n"), HasSubstr("line 3: 3 columns is not allowed"));
}

TEST(Recording, RefusesTimesThatDoNotIncrease) {
  EXPECT_THAT(
      refusalOf("time_s\n0\n0.5\n0.25\n"),
      HasSubstr("line 4, column 1 (time_s): 0.25 is not allowed; times that increase from row to row; before it "
                "stands 0.5"));
  EXPECT_THAT(refusalOf("time_s\n0\n0.5\n0.5\n"), HasSubstr("line 4, column 1 (time_s): 0.5 again"));
}

TEST(Recording, RefusesNumbersThatNoRobotHas) {
  EXPECT_THAT(refusalOf("time_s,ball.x_m\n0,1\n1,-1e308\n"),
              HasSubstr("line 3, column 2 (ball.x_m): \"-1e308\" is not allowed; at most 10000000"));
  EXPECT_THAT(refusalOf("time_s,ball.x_m\n0,1\n1e12,1\n"), HasSubstr("line 3, column 1 (time_s): \"1e12\""));
  // Seconds since 1970, and any number in a column that is no channel.
  EXPECT_EQ(refusalOf("time_s,count\n1763827200.25,1e300\n1763827200.5,2e300\n"), "accepted");
}

TEST(Recording, RefusesAClockThatJumps) {
  std::string rows = "time_s\n";
  for (int i = 0; i < 20; ++i) rows += "0." + std::to_string(100 + i) + "\n";
  EXPECT_THAT(
      refusalOf(rows + "20000\n"),
      HasSubstr("trial.csv line 22, column 1 (time_s): 20000 after 0.119 is not allowed; a pause of at most 1"));
  EXPECT_EQ(refusalOf(rows + "1.1\n"), "accepted");
  // Trials of one file may lie hours apart.
  const Mapping divided = mappingOf(R"({"time_s": {"column": "t"}, "segments": {"column": "piece"}})");
  const TemporaryFolder folder;
  const std::string file = folder.write("all.csv", "t,piece\n0,1\n0.01,1\n0.02,1\n9000,2\n9000.01,2\n9000.02,2\n");
  EXPECT_EQ(loadTrials(file, &divided).size(), 2u);
}

TEST(Recording, RefusesARowThatBelongsToNoTrial) {
  const Mapping divided = mappingOf(R"({"time_s": {"column": "t"}, "segments": {"column": "piece"}})");
  EXPECT_THAT(refusalOf("t,piece\n0,1\n0.01,\n0.02,2\n", &divided),
              HasSubstr("trial.csv line 3, column 2 (piece): an empty cell is not allowed"));
}

TEST(Recording, SaysThatALastLineHasNoEnd) {
  EXPECT_THAT(recordingOf("time_s,ball.x_m\n0,0.25\n1,0.2").notes,
              ElementsAre("the last line, 3, has no line end: it may have been cut off, even inside a number"));
  EXPECT_THAT(recordingOf("time_s,ball.x_m\r0,0.25\r1,0.2\r").notes, testing::IsEmpty());
}

TEST(Recording, KnowsWhereItsNumbersStandAndWhatTheirLastDecimalIsWorth) {
  const Mapping mapping = mappingOf(R"({"time_s": {"column": "t"}, "ball.x_m": {"column": "x", "scale": -0.001}})");
  const Recording trial = recordingOf("x,t,ball.y_m,ball.z_m\n\n1.50,0,4,2.5e-3\n1,1,5,3\n", &mapping);
  EXPECT_THAT(trial.at(1, 1), testing::EndsWith("trial.csv line 4, column 1 (ball.x_m)"));
  EXPECT_THAT(trial.atHeader(0), testing::EndsWith("trial.csv line 1, column 2"));
  ASSERT_EQ(trial.places.lastDigit.size(), 4u);
  EXPECT_EQ(trial.places.lastDigit[0], 0);
  EXPECT_DOUBLE_EQ(trial.places.lastDigit[1], 1e-5);
  EXPECT_EQ(trial.places.lastDigit[2], 0);
  EXPECT_DOUBLE_EQ(trial.places.lastDigit[3], 1e-4);
}

TEST(Recording, RefusesFilesWithoutContent) {
  EXPECT_THAT(refusalOf(""), HasSubstr("trial.csv: the file is empty"));
  EXPECT_THAT(refusalOf("\n\r\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(refusalOf("time_s,ball.x_m\n"), HasSubstr("no row of numbers"));
  EXPECT_THAT(refusalOf("t,q\n0,1\n"), HasSubstr("there is no column time_s; the file has t, q"));
}

TEST(Recording, RefusesRowsOfAnotherWidthAndColumnNamesTwice) {
  EXPECT_THAT(refusalOf("time_s,ball.x_m\n0,1\n1\n"), HasSubstr("line 3: 1 column is not allowed"));
  EXPECT_THAT(refusalOf("time_s,ball.x_m\n0,1,2\n"),
              HasSubstr("line 2: 3 columns is not allowed; as many as the header "
                        "has, 2"));
  EXPECT_THAT(refusalOf("time_s,a,time_s\n0,1,2\n"), HasSubstr("line 1, column 3: \"time_s\" again"));
  EXPECT_THAT(refusalOf("time_s,,a\n0,1,2\n"), HasSubstr("line 1, column 2: the column has no name"));
}

TEST(Recording, RefusesBinaryBytesAndOverlongLines) {
  EXPECT_THAT(refusalOf(std::string("\x7f"
                                    "ELF\x02\x01\n",
                                    7)),
              HasSubstr("column 1: \"?ELF??\" is not allowed; a column"));
  EXPECT_THAT(refusalOf(std::string("time_s\n0\n\0\n", 11)), HasSubstr("line 3, column 1: a NUL byte"));
  EXPECT_THAT(refusalOf("\xff\xfet\0i\0"), HasSubstr("line 1, column 1"));
  EXPECT_THAT(refusalOf("time_s,\xE4ngle\n0,1\n"), HasSubstr("line 1, column 2: the byte 0xE4"));
  EXPECT_THAT(refusalOf("time_s\n" + std::string(5000, '1') + "\n"),
              HasSubstr("line 2, column 1: more than 4096 bytes"));
  std::string wide = "time_s";
  for (int i = 0; i < 10'000; ++i) wide += ",c" + std::to_string(i);
  EXPECT_THAT(refusalOf(wide + "\n"), HasSubstr("more than 10000 columns"));
}

TEST(Recording, RefusesLargeFilesFoldersAndAbsentFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.write("trial.csv", "time_s\n0\n1\n");
  EXPECT_NO_THROW(loadRecording(path, nullptr, 11));
  try {
    loadRecording(path, nullptr, 10);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), path + ": 11 bytes is not allowed; at most 10 bytes");
  }
  EXPECT_THROW(loadRecording(folder.file("")), InputError);
  EXPECT_THROW(loadRecording(folder.file("absent.csv")), InputError);
}

TEST(Recording, ReadsManyRowsAsTheyStand) {
  std::string csv = "time_s,ball.x_m\n";
  constexpr int rows = 100'000;
  for (int i = 0; i < rows; ++i) csv += std::to_string(i) + "," + std::to_string(i % 17) + ".5\n";
  const Recording trial = recordingOf(csv);
  ASSERT_EQ(trial.rows(), std::size_t{rows});
  for (int i = 0; i < rows; i += 997) {
    EXPECT_EQ(trial.columns[0][static_cast<std::size_t>(i)], i);
    EXPECT_EQ(trial.columns[1][static_cast<std::size_t>(i)], i % 17 + 0.5);
  }
  EXPECT_EQ(trial.sha256, sha256(csv));
}

TEST(Mapping, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(mappingRefusal("[1]"), HasSubstr("m.json"));
  EXPECT_THAT(mappingRefusal("{\"time_s\": {\"column\": \"t\"},"), HasSubstr("m.json"));
  EXPECT_THAT(mappingRefusal(R"({"leg.knee.position_rad": {"column": "q"}})"), HasSubstr("\"time_s\" is missing"));
  EXPECT_THAT(mappingRefusal(R"({"time_s": {"column": "t"}, "leg.knee.angle": {"column": "q"}})"),
              HasSubstr("channel \"leg.knee.angle\" is not allowed"));
  EXPECT_THAT(mappingRefusal(R"({"time_s": {"column": "t", "scale": 0}})"), HasSubstr("scale"));
  EXPECT_THAT(mappingRefusal(R"({"time_s": {"column": "t", "scale": -1}})"), HasSubstr("scale"));
  EXPECT_THAT(mappingRefusal(R"({"time_s": {"column": "t", "ofset": 1}})"), HasSubstr("ofset"));
  EXPECT_THAT(mappingRefusal(R"({"time_s": {"scale": 1}})"), HasSubstr("column"));
  EXPECT_THAT(mappingRefusal(R"({"time_s": {"column": "t"}, "settings": [{"file_contains": "", "values": {}}]})"),
              HasSubstr("file_contains"));
}

TEST(Mapping, MaySayWhatIsDoneWithTheRowsAlone) {
  const Mapping mapping = mappingFromJson(R"({"resample": {"lowpass_hz": 10}})", "m.json");
  EXPECT_TRUE(mapping.columns.empty());
  EXPECT_EQ(mapping.lowpass_hz, 10);
  EXPECT_THAT(mappingRefusal("{}"), HasSubstr("\"time_s\" is missing"));
}

TEST(Mapping, MissesNoColumnSilently) {
  const Mapping needed = mappingOf(R"({"time_s": {"column": "t"}, "ball.x_m": {"column": "x"}})");
  EXPECT_THAT(refusalOf("t,y\n0,1\n", &needed),
              HasSubstr("column \"x\" is missing, which m.json maps to ball.x_m; the file has t, y"));
  const Mapping wanted = mappingOf(R"({"time_s": {"column": "t"}, "ball.x_m": {"column": "x", "optional": true}})");
  EXPECT_THAT(recordingOf("t\n0\n", &wanted).notes, ElementsAre("column \"x\" (ball.x_m) is not in this file"));
  const Mapping twice = mappingOf(R"({"time_s": {"column": "t"}, "ball.x_m": {"column": "x"}})");
  EXPECT_THAT(refusalOf("t,x,ball.x_m\n0,1,2\n", &twice), HasSubstr("has the name of a channel"));
}

TEST(ChannelName, FollowsTheContract) {
  const auto joint = parseChannel("leg.left.knee.position_rad");
  ASSERT_TRUE(joint);
  EXPECT_EQ(joint->owner, "leg");
  EXPECT_EQ(joint->part, "left.knee");
  EXPECT_EQ(joint->quantity, "position_rad");
  for (const std::string name :
       {"ball.x_m", "leg.base.qw", "leg.base.duty", "leg.knee.enabled", "cart.slide.velocity_m_s"})
    EXPECT_TRUE(parseChannel(name)) << name;
  for (const std::string name : {"", "time_s", "x_m", ".x_m", "ball.", "ball.qw", "leg.base.angle", "leg..duty",
                                 "leg.knee.angle", "leg.knee.x_m"})
    EXPECT_FALSE(parseChannel(name)) << name;
  // Many arms have a joint of that name.
  EXPECT_TRUE(parseChannel("leg.base.qw")->ofRoot());
  EXPECT_FALSE(parseChannel("leg.base.duty")->ofRoot());
}

}  // namespace
}  // namespace btr
