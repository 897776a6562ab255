#include "core/gap/search/gap_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_html.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/report/report_text.h"
#include "core/gap/search/report_words.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"
#include "core/spec/json_reader.h"
#include "tests/gap/report/sample_report.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

void expectSame(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isnan(a[i]))
      EXPECT_TRUE(std::isnan(b[i])) << i;
    else
      EXPECT_EQ(a[i], b[i]) << i;
}

std::string messageOf(const std::string& folder) {
  return test::refusal([&] { loadReport(folder); });
}

/// Writes the sample, lets `change` alter report.json, and says what loading then complains of.
std::string afterChange(const std::function<void(nlohmann::json&)>& change) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  auto document = nlohmann::json::parse(readFile(folder.file("r/report.json")));
  change(document);
  folder.write("r/report.json", document.dump());
  return messageOf(folder.file("r"));
}

TEST(Figures, OfManyDigitsAreRoundedAndNotWrittenWithPowersOfTen) {
  EXPECT_EQ(digits(0.051234), "0.0512");
  EXPECT_EQ(digits(873.4, 2), "870");
  EXPECT_EQ(digits(-1234.5), "-1230");
  EXPECT_EQ(digits(99.6, 2), "100");
  EXPECT_EQ(digits(0), "0");
}

TEST(GapReport, ComesBackWholeFromItsFolder) {
  const TemporaryFolder folder;
  GapReport written = sampleReport();
  written.cutShort = true;
  writeReport(written, folder.file("a/report"));
  const GapReport read = loadReport(folder.file("a/report"));

  // The text holds all but the tables, so equal texts are equal contents.
  EXPECT_EQ(toJsonText(read), toJsonText(written));
  ASSERT_EQ(read.trials.size(), written.trials.size());
  for (std::size_t t = 0; t < read.trials.size(); ++t) {
    expectSame(read.trials[t].time_s, written.trials[t].time_s);
    ASSERT_EQ(read.trials[t].series.size(), written.trials[t].series.size());
    for (std::size_t s = 0; s < read.trials[t].series.size(); ++s)
      for (const CurveName& curve : curveNames)
        expectSame(read.trials[t].series[s].*curve.values, written.trials[t].series[s].*curve.values);
  }
  EXPECT_EQ(read.next.channels, written.next.channels);
  for (std::size_t i = 0; i < written.next.columns.size(); ++i)
    expectSame(read.next.columns[i], written.next.columns[i]);
  EXPECT_EQ(read.before, written.before);
  EXPECT_EQ(read.after, written.after);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_TRUE(read.cutShort);
}

TEST(GapReport, KeepsTheOrderOfNumbersAndChannels) {
  const TemporaryFolder folder;
  GapReport report = sampleReport();
  std::swap(report.calibrated[0], report.calibrated[1]);
  writeReport(report, folder.file("r"));
  const GapReport read = loadReport(folder.file("r"));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.calibrated[i].name, report.calibrated[i].name);
    EXPECT_EQ(read.tried[0].parameters[i].name, report.tried[0].parameters[i].name);
    EXPECT_EQ(read.channels[i].name, report.channels[i].name);
  }
}

TEST(GapReport, AnEmptyOneComesBackToo) {
  const TemporaryFolder folder;
  writeReport(GapReport{}, folder.file("r"));
  EXPECT_EQ(toJsonText(loadReport(folder.file("r"))), toJsonText(GapReport{}));
  EXPECT_FALSE(std::filesystem::exists(folder.file("r/next_command.csv")));
}

TEST(GapReport, AnOpenIntervalStaysOpen) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  const GapReport read = loadReport(folder.file("r"));
  EXPECT_EQ(read.calibrated[1].ci95.low, 0.02);
  EXPECT_EQ(read.calibrated[1].ci95.high, std::numeric_limits<double>::infinity());
}

TEST(GapReport, ARejectedEffectHasNoInterval) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  const auto document = nlohmann::json::parse(readFile(folder.file("r/report.json")));
  EXPECT_TRUE(document["tried"][2]["parameters"]["torque_nm"]["ci95"].is_null());
  EXPECT_FALSE(loadReport(folder.file("r")).tried[2].parameters[0].ci95.known());
  EXPECT_THAT(toHtml(sampleReport()), AllOf(HasSubstr("torque_nm = 0.004 N·m<"), Not(HasSubstr("0.004 N·m ["))));
  GapReport held = sampleReport();
  held.calibrated[0].ci95 = GapReport::Interval::none();
  EXPECT_THAT(toPlainText(held), Not(HasSubstr("[nan")));
  EXPECT_THAT(toHtml(held), Not(HasSubstr("[–")));
}

// A number on which rivals disagree is not as sure as its own interval: every reader is told.
TEST(GapReport, SaysWhatRivalsWouldMakeOfANumber) {
  const TemporaryFolder folder;
  GapReport report = sampleReport();
  GapReport::Number& gain = report.calibrated[0];
  const std::string own = brief(gain.ci95);
  gain.amongRivals = {gain.ci95.low - 1, gain.ci95.high + 2};
  writeReport(report, folder.file("r"));
  const GapReport read = loadReport(folder.file("r"));
  EXPECT_EQ(read.calibrated[0].amongRivals.low, gain.amongRivals.low);
  EXPECT_EQ(read.calibrated[0].amongRivals.high, gain.amongRivals.high);
  EXPECT_FALSE(read.calibrated[1].amongRivals.known());
  const auto document = nlohmann::json::parse(readFile(folder.file("r/report.json")));
  EXPECT_FALSE(document["calibrated"][read.calibrated[1].name].contains("ci95_among_rivals"));
  EXPECT_THAT(toPlainText(report), HasSubstr(", among rivals ["));
  EXPECT_THAT(toPlainText(sampleReport()), Not(HasSubstr("among rivals")));
  EXPECT_THAT(toHtml(report), HasSubstr(own));
  EXPECT_THAT(toHtml(report), HasSubstr(brief(gain.amongRivals)));
}

TEST(GapReport, OfAnEarlierVersionIsRead) {
  EXPECT_EQ(afterChange([](auto& d) {
              for (auto& effect : d["tried"]) effect.erase("q_value");
              for (auto& trial : d["trials"]) trial["held_out_blocks_s"] = nlohmann::json::array();
              d["provenance"].erase("scene");
              d["provenance"].erase("scene_sha256");
              d["remainder"].erase("law");
              d.erase("explained_share");
              d.erase("disagreeing_trials");
            }),
            "accepted");
}

TEST(GapReport, ANewOneLeavesNothingOfTheOneBeforeIt) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  folder.write("r/overlay/mine.csv", "time_s\n");
  folder.write("r/notes.txt", "mine");
  GapReport next = sampleReport();
  next.trials.resize(1);
  next.located.clear();
  next.next = {};
  next.remainder = {};
  writeReport(next, folder.file("r"));
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("r")))
    if (entry.is_regular_file())
      left.push_back(std::filesystem::relative(entry.path(), folder.file("r")).generic_string());
  EXPECT_THAT(left, testing::UnorderedElementsAre("report.json", "report.html", "simulator.json", "overlay/sine-1.csv",
                                                  "overlay/mine.csv", "notes.txt"));
}

TEST(GapReport, TablesStayInAFolderWhoseReportCannotBeRead) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  folder.write("r/report.json", "{");
  GapReport next = sampleReport();
  next.trials.resize(1);
  next.located.clear();
  writeReport(next, folder.file("r"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("r/overlay/sine-2.csv")));
}

TEST(GapReport, SaysWhatItsErrorsWereMeasuredOn) {
  const std::string html = toHtml(sampleReport());
  EXPECT_THAT(html, HasSubstr("alternate blocks of the trials predict each other"));
  EXPECT_THAT(html, Not(HasSubstr("did not see")));
}

TEST(GapReport, JsonHasTheContractsKeysAndTypes) {
  const auto document = nlohmann::json::parse(toJsonText(sampleReport()));
  EXPECT_EQ(document["format"], "uchilsim-gap-report-1");
  EXPECT_EQ(document["verdict"], "missing_physics");
  EXPECT_TRUE(document["sentence"].is_string());

  const auto& located = document["located"][0];
  EXPECT_EQ(located["channel"], "leg.knee.position_rad");
  EXPECT_EQ(located["share_of_excess_error"], 0.91);
  EXPECT_EQ(located["when"], "velocity_reversal");
  EXPECT_EQ(located["windows_s"][0], nlohmann::json::array({1.2, 1.34}));
  EXPECT_EQ(located["depends_on"], nlohmann::json::array({"leg.knee.velocity_rad_s"}));

  ASSERT_EQ(document["effects"].size(), 1u);
  const auto& effect = document["effects"][0];
  EXPECT_EQ(effect["effect"], "backlash");
  EXPECT_EQ(effect["at"], "leg.knee");
  EXPECT_EQ(effect["parameters"]["width_rad"]["value"], 0.051);
  EXPECT_EQ(effect["parameters"]["width_rad"]["ci95"], nlohmann::json::array({0.047, 0.055}));
  EXPECT_EQ(effect["parameters"]["width_rad"]["at_bound"], false);
  EXPECT_EQ(effect["heldout_error_reduction"], 0.71);
  EXPECT_EQ(effect["p_value"], 0.0004);
  EXPECT_EQ(effect["q_value"], 0.0076);
  EXPECT_EQ(effect["indistinguishable_from"][0]["effect"], "gear_elasticity");
  EXPECT_EQ(effect["indistinguishable_from"][0]["heldout_error_ratio"], 1.02);

  const auto& gain = document["calibrated"]["robots.leg.servos.knee.p"];
  EXPECT_EQ(gain["before"], 4.0);
  EXPECT_EQ(gain["after"], 3.71);
  EXPECT_EQ(gain["ci95"], nlohmann::json::array({3.6, 3.8}));
  EXPECT_EQ(gain["at_bound"], false);

  const auto& channel = document["heldout"]["channels"]["leg.knee.position_rad"];
  EXPECT_EQ(channel["rmse_as_given"], 0.041);
  EXPECT_EQ(channel["rmse_calibrated"], 0.022);
  EXPECT_EQ(channel["rmse_with_effects"], 0.0019);
  EXPECT_EQ(channel["noise_floor"], 0.0016);

  EXPECT_EQ(document["remainder"]["explained_share"], 0.98);
  EXPECT_EQ(document["remainder"]["shape"]["y"].size(), 4u);
  EXPECT_EQ(document["next_recording"]["command_csv"], "next_command.csv");
  EXPECT_EQ(document["provenance"]["seed"], 18446744073709551615u);
  EXPECT_EQ(document["provenance"]["version"], "0.1.0");
  EXPECT_EQ(document["provenance"]["recordings_sha256"].size(), 5u);
}

TEST(GapReport, ARemainderThatIsNothingHasNoShape) {
  GapReport report = sampleReport();
  report.remainder = {0.99, "", "", "", "", {}, {}, {}, 0, 1};
  EXPECT_TRUE(nlohmann::json::parse(toJsonText(report))["remainder"]["shape"].is_null());
}

TEST(GapReport, EveryVerdictHasTheContractsWord) {
  using Verdict = GapReport::Verdict;
  EXPECT_STREQ(toText(Verdict::noMismatch), "no_mismatch");
  EXPECT_STREQ(toText(Verdict::parametersSuffice), "parameters_suffice");
  EXPECT_STREQ(toText(Verdict::missingPhysics), "missing_physics");
  EXPECT_STREQ(toText(Verdict::partlyExplained), "partly_explained");
  EXPECT_STREQ(toText(Verdict::unexplained), "unexplained");
  EXPECT_STREQ(toText(Verdict::notExcited), "not_excited");
}

TEST(GapReport, ALawAndADisagreeingTrialComeBack) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  const auto document = nlohmann::json::parse(readFile(folder.file("r/report.json")));
  EXPECT_EQ(document["explained_share"], 0.98);
  EXPECT_EQ(document["remainder"]["law"]["family"], "detent");
  EXPECT_EQ(document["disagreeing_trials"][0]["trial"], "sine-4.csv");
  EXPECT_EQ(document["trials"][3]["set_aside"], true);
  const GapReport read = loadReport(folder.file("r")), written = sampleReport();
  ASSERT_TRUE(read.law.known());
  EXPECT_EQ(read.law.sentence, written.law.sentence);
  EXPECT_EQ(read.law.curves[0].y, written.law.curves[0].y);
  EXPECT_TRUE(std::isnan(read.law.curves[0].low.back()));
  EXPECT_TRUE(read.trials[3].setAside);
  EXPECT_EQ(read.disagreements[0].what, written.disagreements[0].what);
  EXPECT_THAT(afterChange([](auto& d) { d["remainder"]["law"]["curves"][0]["low"].push_back(1); }),
              HasSubstr("/remainder/law/curves/0/low"));
}

TEST(GapReport, SimulatorFileIsTheRepairedSimulator) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  EXPECT_EQ(loadSimulator(folder.file("r/simulator.json")), sampleReport().after);
}

TEST(GapReport, TrialsOfTheSameNameKeepTheirOwnTables) {
  const TemporaryFolder folder;
  GapReport report = sampleReport();
  for (GapReport::Trial& trial : report.trials) trial.name = "../walk one.csv";
  report.trials[1].series[0].recorded[7] = 42;
  writeReport(report, folder.file("r"));
  const GapReport read = loadReport(folder.file("r"));
  EXPECT_EQ(read.trials[1].series[0].recorded[7], 42);
  EXPECT_NE(read.trials[0].series[0].recorded[7], 42);
  EXPECT_EQ(read.trials[0].name, "../walk one.csv");
}

TEST(GapReport, HtmlRefersToNothingOutside) {
  const std::string html = toHtml(sampleReport());
  for (const char* reference : {"src=", "href=", "url(", "@import", "http:", "https:", "<script", "<link"})
    EXPECT_THAT(html, Not(HasSubstr(reference))) << reference;
}

TEST(GapReport, HtmlEscapesNamesFromFiles) {
  GapReport report = sampleReport("<script>\"x\"&");
  report.notes.push_back("<img src=x>");
  report.trials[0].name = "<b>.csv";
  const std::string html = toHtml(report);
  EXPECT_THAT(html, Not(HasSubstr("<script>")));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
  EXPECT_THAT(html, Not(HasSubstr("<b>.csv")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;&quot;x&quot;&amp;.knee"));
}

TEST(GapReport, HtmlSaysWhatWasRejectedAndWhy) {
  const std::string html = toHtml(sampleReport());
  EXPECT_THAT(html, HasSubstr("explains nothing that the calibration does not"));
  EXPECT_THAT(html, HasSubstr("gear elasticity at leg.knee (error × 1.02)"));
  EXPECT_THAT(html, HasSubstr(sampleReport().trials[3].sha256));
}

TEST(GapReport, HtmlPlotsHaveFiniteNumbersOnly) {
  GapReport report = sampleReport();
  report.ladder[1].error = std::numeric_limits<double>::infinity();
  report.trials[0].series[0].asGiven.assign(500, std::numeric_limits<double>::quiet_NaN());
  report.trials[0].series[0].noiseFloor = 0;
  const std::string html = toHtml(report);
  for (const char* before : {"\"", "\"-", "M", "L", "M-", "L-", " ", " -", "("})
    for (const char* bad : {"nan", "inf"})
      for (const char* after : {"\"", " ", "L", ")"})
        EXPECT_THAT(html, Not(HasSubstr(std::string(before) + bad + after))) << before << bad << after;
}

TEST(HeatRow, IsTheRootMeanSquareInNoiseFloors) {
  GapReport report;
  report.trials.push_back({"t", "", false, {0, 1, 2, 3}, {}});
  report.trials[0].series.push_back({"a.b.position_rad", "rad", 0.5, {1, 1, 1, 1}, {2, 1, 1, 4}, {}, {}});
  const HeatRow row = heatRow(report, 0, 0, Simulated::asGiven, 2);
  EXPECT_DOUBLE_EQ(row.error[0], std::sqrt((2.0 * 2.0 + 0) / 2));
  EXPECT_DOUBLE_EQ(row.error[1], std::sqrt((0 + 6.0 * 6.0) / 2));
  EXPECT_EQ(row.to_s, 3);
}

TEST(HeatColour, GrowsFromTheNoiseFloorOn) {
  EXPECT_EQ(heatColour(0.2).opacity, heatColour(1).opacity);
  EXPECT_LT(heatColour(1).opacity, heatColour(2).opacity);
  EXPECT_LT(heatColour(2).opacity, heatColour(20).opacity);
  EXPECT_EQ(heatColour(std::nan("")).opacity, 0);
}

TEST(HostileGapReport, IsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  EXPECT_THAT(messageOf(folder.file("none")), HasSubstr("there is no such folder"));
  EXPECT_THAT(messageOf(folder.file("")), HasSubstr("report.json"));
  EXPECT_THAT(afterChange([](auto& d) { d["verdict"] = "guilty"; }), HasSubstr("/verdict: \"guilty\" is not allowed"));
  EXPECT_THAT(afterChange([](auto& d) { d["tried"][0]["p_value"] = "small"; }), HasSubstr("/tried/0/p_value"));
  EXPECT_THAT(afterChange([](auto& d) { d["located"][0]["windows_s"][0] = 3; }), HasSubstr("windows_s"));
  EXPECT_THAT(afterChange([](auto& d) { d["located"][0]["window_trials"][0] = 99; }), HasSubstr("trial 99"));
  EXPECT_THAT(afterChange([](auto& d) { d["remainder"]["shape"]["y"].push_back(1); }),
              HasSubstr("as many numbers as x"));
  EXPECT_THAT(afterChange([](auto& d) { d["extra"] = 1; }), HasSubstr("\"extra\" is not known"));
  EXPECT_THAT(afterChange([](auto& d) { d.erase("heldout"); }), HasSubstr("/heldout: is missing"));
  EXPECT_THAT(afterChange([](auto& d) { d["calibrated"] = {1, 2}; }), HasSubstr("/calibrated"));
  EXPECT_THAT(afterChange([](auto& d) { d["next_recording"]["command_csv"] = "/etc/passwd"; }),
              HasSubstr("command_csv"));
}

TEST(HostileGapReport, ReadsNoFileOutsideItsFolder) {
  for (const char* path : {"/etc/passwd", "../x.csv", "overlay/../../x.csv", "overlay/", "x.csv"})
    EXPECT_THAT(afterChange([&](auto& d) { d["trials"][0]["overlay"] = path; }), HasSubstr("/trials/0/overlay"))
        << path;
}

TEST(HostileGapReport, TablesThatDoNotFitAreRefusedWithLine) {
  const TemporaryFolder folder;
  writeReport(sampleReport(), folder.file("r"));
  const std::string table = "r/overlay/sine-1.csv", whole = readFile(folder.file(table));
  folder.write(table, whole + "1,2\n");
  EXPECT_THAT(messageOf(folder.file("r")), HasSubstr("line 502: 2 columns"));
  folder.write(table, whole + "4,x,2,3,4,5,6,7,8\n");
  EXPECT_THAT(messageOf(folder.file("r")), HasSubstr("line 502, column 2"));
  folder.write(table, "time_s,other\n1,2\n");
  EXPECT_THAT(messageOf(folder.file("r")), HasSubstr("the columns are not those"));
  folder.write(table, "");
  EXPECT_THAT(messageOf(folder.file("r")), HasSubstr("is empty"));
  std::filesystem::remove(folder.file(table));
  EXPECT_THAT(messageOf(folder.file("r")), HasSubstr("there is no such file"));
}

TEST(HostileGapReport, AFolderThatCannotBeMadeIsRefused) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  EXPECT_THROW(writeReport(sampleReport(), folder.file("file/r")), InputError);
}

}  // namespace
}  // namespace btr
