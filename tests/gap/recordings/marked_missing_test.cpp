// Numbers that stand for "no value".
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/trials.h"
#include "core/spec/error.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A sine in counts of 2000 a radian about `middle`, with `marker` in every 40th row; a torque that is 0 or 5.
std::string table(int middle, const std::string& marker) {
  std::string text = "t,q,tau\n";
  for (int row = 0; row < 400; ++row) {
    const long counts = middle + std::lround(600 * std::sin(0.02 * row));
    text += std::to_string(0.005 * row) + "," + (row % 40 == 7 ? marker : std::to_string(counts)) + "," +
            (row % 50 < 5 ? "5" : "0") + "\n";
  }
  return text;
}

std::string mapping(const std::string& keys = "") {
  return R"({"time_s": {"column": "t"}, "leg.knee.position_rad": {"column": "q", "scale": 0.0005, "offset": -0.1)" +
         keys + R"(}, "leg.knee.torque_nm": {"column": "tau"}})";
}

Recording read(const std::string& text, const std::string& howMapped) {
  const TemporaryFolder folder;
  folder.write("a.csv", text);
  const Mapping how = mappingFromJson(howMapped, "mapping");
  return loadRecording(folder.file("a.csv"), &how);
}

long missing(const Recording& trial, std::size_t column) {
  return std::ranges::count_if(trial.columns[column], [](double value) { return std::isnan(value); });
}

TEST(MarkedMissing, NumbersFarFromTheMotionAreNoValues) {
  for (const char* marker : {"-999", "65535", "-32768", "-100000"}) {
    const Recording trial = read(table(200, marker), mapping());
    EXPECT_EQ(missing(trial, 1), 10) << marker;
    EXPECT_THAT(trial.notes, Contains(HasSubstr(std::string(marker) + " stands in 10 cells"))) << marker;
    EXPECT_NEAR(trial.columns[1][0], 0.0005 * 200 - 0.1, 1e-12);
  }
}

TEST(MarkedMissing, TheMappingSaysWhatTheyAre) {
  EXPECT_EQ(missing(read(table(200, "-999"), mapping(", \"missing\": false")), 1), 0);
  const Recording within = read(table(200, "0"), mapping(", \"missing\": 0"));
  EXPECT_GE(missing(within, 1), 10) << "a number within the motion's range, as from a bus that was late";
  EXPECT_EQ(missing(read(table(200, "0"), mapping()), 1), 0);
}

/// A torque of 0 or 5.
TEST(MarkedMissing, WhatMayJumpIsLeftAlone) {
  const Recording trial = read(table(200, "200"), mapping());
  EXPECT_THAT(trial.notes, Not(Contains(HasSubstr("no value"))));
}

/// A counter of 16 bits that goes below zero by one is at −1, not missing.
TEST(MarkedMissing, ACounterThatPassesZeroIsFollowed) {
  std::string text = "t,q,tau\n";
  for (int row = 0; row < 400; ++row) {
    const long counts = std::lround(150 + 151 * std::sin(0.05 * row));
    text += std::to_string(0.005 * row) + "," + std::to_string(counts < 0 ? counts + 65536 : counts) + ",0\n";
  }
  const Recording trial = read(text, mapping());
  EXPECT_EQ(missing(trial, 1), 0);
  for (const double value : trial.columns[1]) EXPECT_LT(std::abs(value), 0.2);
}

TEST(Mapping, MaySayItsFormat) {
  const std::string begin = R"({"format": "uchilsim-)";
  EXPECT_EQ(mappingFromJson(begin + R"(mapping-1", "time_s": {"column": "t"}})", "m").columns.size(), 1u);
  EXPECT_THROW(mappingFromJson(begin + R"(scene-1", "time_s": {"column": "t"}})", "m"), InputError);
}

TEST(MarkedMissing, TheKeyIsANumberOrFalse) {
  EXPECT_THROW(mappingFromJson(mapping(", \"missing\": \"NA\""), "m"), InputError);
  EXPECT_THROW(mappingFromJson(R"({"time_s": {"column": "t", "missing": -1}})", "m"), InputError);
  EXPECT_THROW(mappingFromJson(mapping(R"(, "missing": -1, "add": [{"column": "tau"}])"), "m"), InputError);
}

}  // namespace
}  // namespace btr
