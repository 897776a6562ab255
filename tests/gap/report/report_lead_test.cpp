#include "core/gap/report/report_lead.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/gap/report/equation.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_html.h"
#include "core/gap/report/report_plots.h"
#include "core/plugin/plugin_host.h"
#include "core/spec/json_reader.h"
#include "tests/gap/report/sample_report.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReportLead, SaysWhatWasFoundWhereAndHowLarge) {
  const ReportLead lead = leadOf(sampleReport());
  EXPECT_EQ(lead.headline, "Backlash at leg.knee was left out");
  EXPECT_FALSE(lead.isWarning);
  ASSERT_EQ(lead.findings.size(), 1u);
  EXPECT_THAT(lead.findings[0].text, HasSubstr("width_rad = 0.051 rad [0.047, 0.055]"));
  EXPECT_THAT(lead.findings[0].text, HasSubstr("cannot tell it from gear elasticity at leg.knee"));
}

// 1 − 0.9 is a tenth: without the effect the error is ten times as large.
TEST(ReportLead, SaysHowMuchLargerTheErrorIsWithoutAnEffect) {
  GapReport::Effect effect;
  effect.heldoutErrorReduction = 0.9;
  EXPECT_THAT(withoutInWords(effect), HasSubstr("is 10 times as large"));
  effect.heldoutErrorReduction = 0.99999;
  EXPECT_THAT(withoutInWords(effect), HasSubstr("is more than 1000 times as large"));
  for (const double nothing : {0.0, -0.1, static_cast<double>(NAN)}) {
    effect.heldoutErrorReduction = nothing;
    EXPECT_EQ(withoutInWords(effect), "");
  }
}

// What is not quite all, or not quite nothing, is not rounded to it.
TEST(ReportLead, DoesNotRoundToAll) {
  GapReport report = sampleReport();
  report.explainedShare = 0.999;
  EXPECT_THAT(leadOf(report).explained, HasSubstr("together take more than 99 % of the squared error that the"));
  for (GapReport::Channel& c : report.channels) c.heldoutWithEffects = c.heldoutAsGiven / 1000;
  EXPECT_THAT(leadOf(report).errorText, HasSubstr("more than 99 % less"));
}

TEST(ReportLead, GivesErrorsInTheChannelsUnitOfRecordingsThatNoFitSaw) {
  const ReportLead lead = leadOf(sampleReport());
  EXPECT_TRUE(lead.heldOut);
  ASSERT_EQ(lead.errors.size(), 2u);
  EXPECT_EQ(lead.errors[0].channel, "leg.knee.position_rad");  // the worst as given first
  EXPECT_EQ(lead.errors[0].before, 0.043);
  EXPECT_EQ(lead.errors[0].after, 0.002);
  // 1 − 0.002/0.043 = 95.3 %
  EXPECT_THAT(lead.errorText, HasSubstr("0.043 rad as given and by 0.002 rad"));
  EXPECT_THAT(lead.errorText, HasSubstr("95 % less"));
  ASSERT_TRUE(lead.picture.has_value());
  EXPECT_TRUE(sampleReport().trials[lead.picture->first].heldOut);
}

TEST(ReportLead, SaysSoWhereNothingWasHeldOut) {
  GapReport report = sampleReport();
  for (GapReport::Trial& trial : report.trials) trial.heldOut = false;
  for (GapReport::Channel& c : report.channels) c.heldoutAsGiven = c.heldoutCalibrated = c.heldoutWithEffects = 0;
  const ReportLead lead = leadOf(report);
  EXPECT_FALSE(lead.heldOut);
  EXPECT_EQ(lead.errors.at(0).before, 0.041);
  EXPECT_THAT(lead.errorText, HasSubstr("Cross-validated"));
  EXPECT_THAT(lead.next, testing::Contains(HasSubstr("--held-out")));
}

// A success on what was fitted is none where what was held out got worse: that is the headline, and nobody is told to
// adopt it.
TEST(ReportLead, WarnsFirstWhereHeldOutRecordingsGotWorse) {
  GapReport report = sampleReport();
  for (GapReport::Channel& c : report.channels) c.heldoutWithEffects = 1.3 * c.heldoutAsGiven;
  const ReportLead lead = leadOf(report);
  EXPECT_TRUE(lead.isWarning);
  EXPECT_THAT(lead.headline, HasSubstr("held out got worse"));
  EXPECT_THAT(lead.next.at(0), HasSubstr("Do not adopt"));
  EXPECT_THAT(leadHtml(report, lead), HasSubstr("Backlash at leg.knee was left out"));
}

TEST(ReportLead, NamesUpToThreeAndCountsTheRest) {
  GapReport report = sampleReport();
  for (const char* name : {"coulomb_friction", "command_delay", "payload"}) {
    GapReport::Effect effect;
    effect.effect = name;
    effect.at = "leg.hip";
    effect.accepted = true;
    report.tried.insert(report.tried.begin() + 1, effect);
  }
  EXPECT_EQ(leadOf(report).headline,
            "Backlash at leg.knee, payload at leg.hip, command delay at leg.hip and 1 more were left out");
  report.verdict = GapReport::Verdict::unexplained;
  EXPECT_THAT(leadOf(report).headline, Not(HasSubstr("left out")));
}

TEST(ReportLead, NamesAnEffectAtSeveralJointsOnce) {
  GapReport report = sampleReport();
  for (const char* joint : {"leg.ankle", "leg.hip"}) {
    GapReport::Effect effect;
    effect.effect = "backlash";
    effect.at = joint;
    effect.accepted = true;
    report.tried.insert(report.tried.begin() + 1, effect);
  }
  EXPECT_EQ(leadOf(report).headline, "Backlash at leg.knee, leg.hip and leg.ankle were left out");
}

TEST(ReportLead, SaysWhatStandsInTheWay) {
  GapReport report = sampleReport();
  report.verdict = GapReport::Verdict::notExcited;
  EXPECT_THAT(leadOf(report).next.at(0), HasSubstr("Record larger and faster motions"));
  report.nextStep = "Let the joints follow the recorded motion.";
  EXPECT_EQ(leadOf(report).next.at(0), report.nextStep);
  EXPECT_THAT(leadOf(sampleReport()).next, testing::Contains(HasSubstr("next_command.csv")));
  EXPECT_THAT(leadOf(sampleReport()).next, testing::Contains(HasSubstr("links.lower.mass_kg ends at its bound")));
}

TEST(ReportLead, NamesTrialsThatDisagreeAndTheLawOfTheRest) {
  const GapReport report = sampleReport();
  const ReportLead lead = leadOf(report);
  ASSERT_EQ(lead.disagree.size(), 1u);
  EXPECT_THAT(lead.disagree[0], HasSubstr("sine-4.csv was set aside: its robots.leg.links.lower.mass_kg"));
  EXPECT_THAT(lead.next, testing::Contains(HasSubstr("Look at sine-4.csv")));
  EXPECT_THAT(lead.rest, HasSubstr("pulls toward 0.35 rad"));
  EXPECT_THAT(lead.explained, HasSubstr("98 % of the squared error"));
  GapReport partly = report;
  partly.verdict = GapReport::Verdict::partlyExplained;
  EXPECT_EQ(leadOf(partly).headline, "Backlash at leg.knee was left out, and something else is left");
  EXPECT_THAT(toHtml(report), HasSubstr("What has no name: a force over position"));
}

TEST(ReportLead, OfAnEmptyReportIsNoCrash) {
  const ReportLead lead = leadOf(GapReport{});
  EXPECT_FALSE(lead.picture.has_value());
  EXPECT_FALSE(leadHtml(GapReport{}, lead).empty());
}

TEST(ReportLead, EscapesWhatComesFromFiles) {
  const GapReport report = sampleReport("<script>\"x\"&");
  EXPECT_THAT(leadHtml(report, leadOf(report)), Not(HasSubstr("<script>")));
}

TEST(Equation, SetsQuantitiesInItalicsAndIndicesBelowTheLine) {
  EXPECT_EQ(equationHtml("τ = −T·sign(ω)"), "<i>τ</i> = −<i>T</i>·sign(<i>ω</i>)");
  EXPECT_EQ(equationHtml("ω_s^2"), "<i>ω</i><sub>s</sub><sup>2</sup>");
  EXPECT_EQ(equationHtml("R^−1·g"), "<i>R</i><sup>−1</sup>·<i>g</i>");
  EXPECT_EQ(equationHtml("θ̈ < q̇"), "<i>θ̈</i> &lt; <i>q̇</i>");
  EXPECT_EQ(equationHtml("a_"), "<i>a</i>_");
  EXPECT_EQ(equationHtml(""), "");
}

// Every effect that the program ships says what it is, and its law comes back from a stored report.
TEST(Equation, EveryShippedEffectHasALawThatSurvivesAFile) {
  PluginHost host(PLUGIN_DIR);
  GapReport report = sampleReport();
  report.tried.clear();
  for (const std::string& name : host.effects()) {
    GapReport::Effect effect;
    effect.effect = name;
    effect.at = "leg.knee";
    effect.accepted = true;
    effect.law = host.effect(name)->law();
    EXPECT_NE(effect.law.acts, EffectLaw::Acts::notSaid) << name;
    EXPECT_FALSE(effect.law.says.empty() || effect.law.equation.empty() || effect.law.symbols.empty() ||
                 effect.law.source.empty())
        << name;
    report.tried.push_back(effect);
  }
  const TemporaryFolder folder;
  writeReport(report, folder.file("r"));
  const GapReport read = loadReport(folder.file("r"));
  ASSERT_EQ(read.tried.size(), report.tried.size());
  for (std::size_t i = 0; i < read.tried.size(); ++i) {
    EXPECT_EQ(read.tried[i].law.acts, report.tried[i].law.acts);
    EXPECT_EQ(read.tried[i].law.says, report.tried[i].law.says);
    EXPECT_EQ(read.tried[i].law.equation, report.tried[i].law.equation);
    EXPECT_EQ(read.tried[i].law.symbols, report.tried[i].law.symbols);
    EXPECT_EQ(read.tried[i].law.source, report.tried[i].law.source);
  }
}

// No name is cut, however long, and none lies over another: names have a line of their own.
TEST(ReportPlots, GiveLongNamesALineOfTheirOwn) {
  GapReport report = sampleReport();
  const std::string step = "+ load_dependent_friction at robot_with_a_long_name.left_front_shoulder_rotator";
  report.ladder.push_back({step, 1.05, 0.01});
  const std::string svg = plots::ladder(report);
  const std::size_t at = svg.find(step);
  ASSERT_NE(at, std::string::npos);
  const std::string element = svg.substr(svg.rfind("<text", at), at - svg.rfind("<text", at));
  EXPECT_THAT(element, Not(HasSubstr("text-anchor=\"end\""))) << element;
  // 12 px letters of at most 8 px each, from x = 12, on a picture of 860.
  EXPECT_LT(12 + 8 * static_cast<double>(step.size()), 860.0);
}

TEST(ReportPlots, MarkWhereAnEffectActs) {
  const std::string svg = plots::chain({EffectLaw::Acts::gear}, false);
  EXPECT_THAT(svg, HasSubstr("acts at: gear"));
  EXPECT_EQ(plots::chain({EffectLaw::Acts::notSaid}, false), "");
}

TEST(ReportHtml, BeginsWithTheFindingAndAPictureBeforeAnyTable) {
  const std::string html = toHtml(sampleReport());
  const std::size_t headline = html.find("Backlash at leg.knee was left out"), picture = html.find("<svg"),
                    next = html.find("What to do next"), tables = html.find("<h2>");
  ASSERT_NE(headline, std::string::npos);
  ASSERT_NE(next, std::string::npos);
  EXPECT_LT(headline, next);
  EXPECT_LT(next, picture);
  EXPECT_LT(picture, tables);
}

}  // namespace
}  // namespace btr
