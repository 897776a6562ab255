// What recordings told of a simulator's numbers, and bounds narrowed to it.
#include "core/run/reality/identified_numbers.h"
#include "core/gap/search/gap_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace btr {
namespace {

/// A version of that number, made from the one before, with evidence that calibrated one number to that interval.
SimulatorRecord calibrating(int number, const std::string& name, GapReport::Interval interval) {
  SimulatorRecord version;
  version.number = number;
  version.id = 100 + number;
  version.parent = 99 + number;
  version.madeBy = "gap analysis";
  version.evidence = nlohmann::json{{"calibrated", toEvidence({{name, "", 1, 1, interval}})}}.dump();
  return version;
}
SimulatorRecord telling(int number, const std::string& evidence) {
  SimulatorRecord version = calibrating(number, "", GapReport::Interval::none());
  version.evidence = evidence;
  return version;
}

TEST(IdentifiedNumbers, AreThoseOfTheNewestAnalysisThatTellsThem) {
  const std::vector<SimulatorRecord> versions{
      telling(0, "{}"), calibrating(1, "friction", {0.5, 0.9}), telling(2, R"({"stage":1,"error":0.1})"),
      calibrating(3, "friction", {0.7, 0.8}), calibrating(4, "slip1_m_s_n", GapReport::Interval::none())};
  const auto told = identifiedNumbers(versions, versions[4]);
  ASSERT_EQ(told.size(), 1u);  // no recording tells the slip
  EXPECT_EQ(told.at("friction").low, 0.7);
  EXPECT_EQ(told.at("friction").high, 0.8);
  EXPECT_EQ(identifiedNumbers(versions, versions[2]).at("friction").low, 0.5);
  EXPECT_TRUE(identifiedNumbers(versions, versions[0]).empty());
}

TEST(IdentifiedNumbers, OfARevertedSimulatorAreThoseThatTheOlderOneHad) {
  std::vector<SimulatorRecord> versions{telling(0, ""), calibrating(1, "friction", {0.5, 0.9}),
                                        calibrating(2, "friction", {0.7, 0.8}),
                                        telling(3, R"({"reverts_to":1,"from":2})")};
  EXPECT_EQ(identifiedNumbers(versions, versions[3]).at("friction").low, 0.5);
  versions.push_back(telling(4, R"({"reverts_to":0,"from":3})"));
  EXPECT_TRUE(identifiedNumbers(versions, versions[4]).empty());
}

TEST(IdentifiedNumbers, NarrowBoundsThatStillHoldThePresentValue) {
  const std::vector<Parameter> declared{{"a", "", "told", 0, 10, 5},
                                        {"b", "", "not told", 0, 10, 5},
                                        {"c", "", "told elsewhere since", 0, 10, 5},
                                        {"d", "", "told beyond its range", 0, 10, 5}};
  const auto within =
      withinIdentified(declared, {{"a", {2, 3}}, {"c", {2, 3}}, {"d", {-1, 11}}}, std::vector<double>{2.5, 7, 4, 9});
  const std::vector<std::pair<double, double>> expected{{2, 3}, {0, 10}, {2, 4}, {0, 10}};
  ASSERT_EQ(within.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(within[i].minimum, expected[i].first) << i;
    EXPECT_EQ(within[i].maximum, expected[i].second) << i;
    EXPECT_GE(within[i].byDefault, within[i].minimum);
    EXPECT_LE(within[i].byDefault, within[i].maximum);
  }
}

TEST(IdentifiedNumbers, MayBeTheOnlyOnesThatChange) {
  const std::vector<Parameter> declared{{"a", "", "told", 0, 10, 5}, {"b", "", "not told", 0, 10, 5}};
  const auto within = withinIdentified(declared, {{"a", {2, 3}}}, std::vector<double>{2.5, 7}, Unidentified::stay);
  EXPECT_EQ(within[0].maximum, 3);
  EXPECT_EQ(within[1].minimum, 7);
  EXPECT_EQ(within[1].maximum, 7);
  // Before the recordings, or where no number of L3 was told, nothing is held: L3 would have nothing to do.
  EXPECT_EQ(withinIdentified(declared, {{"c", {2, 3}}}, std::vector<double>{2.5, 7}, Unidentified::stay)[1].maximum,
            10);
}

}  // namespace
}  // namespace btr
