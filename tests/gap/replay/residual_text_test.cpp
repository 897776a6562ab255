#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/overlay.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/residual_text.h"

namespace btr {
namespace {

using testing::HasSubstr;
using testing::Not;

ChannelError swing(std::size_t samples) {
  ChannelError error;
  error.recording = "logs/first & <best> \"run\".csv";
  error.channel = "leg.knee.position_rad";
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = 0.005 * static_cast<double>(i);
    error.time_s.push_back(t);
    error.recorded.push_back(std::sin(3 * t));
    error.simulated.push_back(std::sin(3 * t) + 0.25);
  }
  error.samples = samples;
  error.meanAbsolute = error.rootMeanSquare = error.maximum = error.bias = 0.25;
  error.resolution = 0.001;
  return error;
}

/// All path elements of a class in a picture.
std::vector<std::string> paths(const std::string& svg, const std::string& kind) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  std::vector<std::string> found;
  for (auto* path = document.FirstChildElement("svg")->FirstChildElement("path"); path;
       path = path->NextSiblingElement("path"))
    if (path->Attribute("class", kind.c_str())) found.push_back(path->Attribute("d"));
  return found;
}

TEST(OverlaySvg, IsWellFormedWhateverTheNamesAre) {
  const std::string svg = overlaySvg(swing(500));
  // Legend and curve.
  EXPECT_EQ(paths(svg, "recorded").size(), 2u);
  EXPECT_EQ(paths(svg, "simulated").size(), 2u);
  EXPECT_EQ(paths(svg, "error").size(), 1u);
  EXPECT_THAT(svg, HasSubstr("first &amp; &lt;best&gt; &quot;run&quot;.csv"));
  EXPECT_THAT(svg, HasSubstr(">position [rad]</text>"));
  EXPECT_THAT(svg, HasSubstr("time [s]"));
  EXPECT_THAT(svg, HasSubstr("mean |error| 0.25 rad"));
  EXPECT_THAT(svg, Not(HasSubstr("href")));  // nothing is fetched from elsewhere
}

TEST(OverlaySvg, DoesNotGrowWithTheRecording) {
  const std::string small = overlaySvg(swing(2'000)), large = overlaySvg(swing(400'000));
  EXPECT_LT(large.size(), 4 * small.size());
  EXPECT_LT(large.size(), 500'000u);
}

TEST(OverlaySvg, KeepsASingleSpikeOfALongRecording) {
  ChannelError error = swing(200'000);
  error.recorded[123'456] = 40;
  const auto flat = paths(overlaySvg(swing(200'000)), "recorded").back();
  EXPECT_NE(paths(overlaySvg(error), "recorded").back(), flat);
  EXPECT_THAT(overlaySvg(error), HasSubstr(">40</text>"));
}

TEST(OverlaySvg, BreaksTheLineWhereValuesAreMissing) {
  ChannelError error = swing(50);
  error.recorded[20] = error.simulated[30] = std::nan("");
  const auto svg = overlaySvg(error);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const auto strokes = [](const std::string& path) { return std::count(path.begin(), path.end(), 'M'); };
  EXPECT_EQ(strokes(paths(svg, "recorded").back()), 2);
  EXPECT_EQ(strokes(paths(svg, "simulated").back()), 2);
  EXPECT_EQ(strokes(paths(svg, "error").back()), 3);
}

TEST(OverlaySvg, SurvivesConstantAndEmptyCurves) {
  ChannelError error = swing(3);
  error.recorded = error.simulated = {0, 0, 0};
  EXPECT_THAT(overlaySvg(error), Not(HasSubstr("nan")));
  error.recorded = error.simulated = {std::nan(""), std::nan(""), std::nan("")};
  EXPECT_THAT(overlaySvg(error), Not(HasSubstr("nan")));
  EXPECT_TRUE(paths(overlaySvg(ChannelError{}), "error").back().empty());
}

TEST(ResidualTable, HasARowForEachChannelThenTheMeansThenTheNotes) {
  ChannelError first = swing(10), second = swing(30);
  second.recording = "logs/second.csv";
  second.meanAbsolute = 0.75;
  second.maximum = 2;
  const std::string table = residualTable({{first, second}, {"second.csv: something"}});
  EXPECT_THAT(table, HasSubstr("mean |error|"));
  EXPECT_THAT(table,
              testing::ContainsRegex("second.csv +leg.knee.position_rad +rad +30 +0.75 +0.25 +2 +0.25 +0.001\n"));
  EXPECT_THAT(table, testing::ContainsRegex("mean of 2 +leg.knee.position_rad +rad +40 +0.5 +0.25 +2 +0.25 +0.001\n"));
  EXPECT_THAT(table, HasSubstr("\nnote: second.csv: something\n"));
  EXPECT_THAT(residualTable({{first}, {}}), Not(HasSubstr("mean of")));
}

TEST(ResidualJson, HoldsTheNumbersAndNullForNone) {
  ChannelError first = swing(10), none = swing(0);
  none.channel = "ball.x_m";
  const auto json = nlohmann::json::parse(toJsonText({{first, none}, {"a note"}}));
  EXPECT_EQ(json["format"], "uchilsim-residual-1");
  EXPECT_EQ(json["channels"][0]["mean_absolute_error"], 0.25);
  EXPECT_EQ(json["channels"][0]["recording"], first.recording);
  EXPECT_EQ(json["channels"][0]["unit"], "rad");
  EXPECT_TRUE(json["channels"][1]["bias"].is_null());
  EXPECT_EQ(json["means"].size(), 2u);
  EXPECT_EQ(json["notes"][0], "a note");
}

TEST(UnitOfChannel, IsReadFromItsName) {
  EXPECT_EQ(unitOfChannel("a.b.velocity_rad_s"), "rad/s");
  EXPECT_EQ(unitOfChannel("a.b.torque_nm"), "N·m");
  EXPECT_EQ(unitOfChannel("a.b.velocity_m_s"), "m/s");
  EXPECT_EQ(unitOfChannel("a.b.force_n"), "N");
  EXPECT_EQ(unitOfChannel("ball.x_m"), "m");
  EXPECT_EQ(unitOfChannel("a.base.qw"), "");
}

}  // namespace
}  // namespace btr
