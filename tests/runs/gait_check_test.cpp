// Published gaits as a check on reality.
#include "core/run/reality/gait_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

using test::host;

std::vector<std::string> gaitFiles() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/resources/gaits"))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// A gait of our own with a made-up speed, short.
GaitSpec gait(const std::string& name, double real, double speed = 0.18) {
  GaitSpec spec;
  spec.name = name;
  spec.scene = "../scenes/walk.json";
  spec.directory = SOURCE_DIR "/resources/gaits";
  spec.controller = {"walk", {{"duration_s", 3}}, {}};
  spec.parameters = {{"ground_speed_m_s", speed}};
  spec.fitness = {"walk_speed", {}, {}};
  spec.real = real;
  return spec;
}

GaitCheckOptions quick(int jobs = 2) {
  GaitCheckOptions options;
  options.generations = 3;
  options.population = 6;
  options.jobs = jobs;
  return options;
}

TEST(Gaits, AllThatComeWithTheProgramCanBePreparedAndNameTheirSource) {
  EXPECT_GE(gaitFiles().size(), 8u);
  for (const std::string& file : gaitFiles()) {
    const GaitSpec spec = loadGait(file);
    EXPECT_NO_THROW(prepareGait(spec, host())) << file;
    EXPECT_FALSE(spec.source.empty() || spec.certainty.empty()) << file;
  }
}

TEST(Gaits, AreRefusedWhereSomethingIsWrong) {
  const std::string good = readFile(SOURCE_DIR "/resources/gaits/kohl_stone_start.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return prepareGait(gaitFromJson(text, "gait.json", SOURCE_DIR "/resources/gaits"), host());
  };
  EXPECT_NO_THROW(with("24.5", "25"));
  EXPECT_THROW(with("24.5", "0"), InputError);
  EXPECT_THROW(with("measured\",", "guessed\","), InputError);
  EXPECT_THROW(with("cycle_s", "cycle"), InputError);
  EXPECT_THROW(with("0.704", "7"), InputError);
  EXPECT_THROW(with("half_ellipse", "no_such_controller"), InputError);
  EXPECT_THROW(with("walk-ers210.json", "no_such_scene.json"), InputError);
  EXPECT_THROW(with("\"note\"", "\"remark\""), InputError);
}

TEST(GaitCheck, FindsASimulatorInWhichTheGaitsGoAsFastAsInReality) {
  // Reality is a slower one: what the same gaits reach on a slippery floor with weak servos.
  std::atomic<bool> stop{false};
  std::vector<GaitSpec> gaits{gait("slow", 1, 0.12), gait("fast", 1, 0.24), gait("between", 1, 0.18)};
  SimulatorSpec concealed;
  concealed.values = {{"friction", 0.35}, {"servo_p_nm_rad", 3}, {"slip1_m_s_n", 0.04}};
  for (GaitSpec& g : gaits) {
    const PreparedGait prepared = prepareGait(g, host());
    const auto& e = prepared.experiment;
    g.real = e.fitnessOf(e.trial(e.scene(concealed), prepared.parameters, 1, false));
  }
  const auto check = checkGaits(gaits, {false, false, true}, host(), quick(), stop);
  ASSERT_TRUE(check);
  EXPECT_GT(check->errorBefore, 0.05);
  EXPECT_LT(check->errorAfter, check->errorBefore);
  EXPECT_FALSE(check->after.values.empty());
  EXPECT_TRUE(check->gaits[2].heldOut);
  // What is told is what the adapted simulator gives.
  const PreparedGait fast = prepareGait(gaits[1], host());
  const auto& e = fast.experiment;
  EXPECT_EQ(check->gaits[1].after, e.fitnessOf(e.trial(e.scene(check->after), fast.parameters, 1, false)));
}

TEST(GaitCheck, HasTheSameBitsOnAnyNumberOfWorkers) {
  std::atomic<bool> stop{false};
  const std::vector<GaitSpec> gaits{gait("one", 9), gait("other", 15, 0.24)};
  const auto one = checkGaits(gaits, {false, false}, host(), quick(1), stop);
  const auto four = checkGaits(gaits, {false, false}, host(), quick(4), stop);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->errorAfter, four->errorAfter);
  EXPECT_EQ(one->after, four->after);
}

TEST(GaitCheck, KeepsTheStartingNumbersWhereTheyAreBest) {
  std::atomic<bool> stop{false};
  GaitSpec perfect = gait("perfect", 1);
  const PreparedGait prepared = prepareGait(perfect, host());
  const auto& e = prepared.experiment;
  perfect.real = e.fitnessOf(e.trial(e.scene({}), prepared.parameters, 1, false));
  const auto check = checkGaits({perfect}, {false}, host(), quick(), stop);
  ASSERT_TRUE(check);
  EXPECT_EQ(0, check->errorBefore);
  EXPECT_EQ(0, check->errorAfter);
  EXPECT_TRUE(check->after.values.empty());
}

TEST(GaitCheck, RefusesToFitNothingAndStopsWhenAsked) {
  std::atomic<bool> stop{false};
  GaitSpec commanded = gait("commanded", 35);
  commanded.measured = false;
  EXPECT_THROW(checkGaits({commanded}, {false}, host(), quick(), stop), InputError);
  EXPECT_THROW(checkGaits({gait("held out", 10)}, {true}, host(), quick(), stop), InputError);
  GaitCheckOptions unknown = quick();
  unknown.adapted = {"no_such_parameter"};
  EXPECT_THROW(checkGaits({gait("one", 10)}, {false}, host(), unknown, stop), InputError);
  stop = true;
  EXPECT_FALSE(checkGaits({gait("one", 10)}, {false}, host(), quick(), stop));
}

}  // namespace
}  // namespace btr
