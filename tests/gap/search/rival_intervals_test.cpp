// What rivals would make of a number, against intervals laid out by hand.
#include "core/gap/search/rivals/rival_intervals.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/gap_report.h"

#include <gtest/gtest.h>

#include <limits>

namespace btr {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

FitParameter numberOf(const std::string& name, int effect, double minimum, double maximum) {
  FitParameter p;
  p.name = name;
  p.effect = effect;
  p.minimum = minimum;
  p.maximum = maximum;
  return p;
}

/// A number's half interval is 1.96 standard errors.
Uncertainty errorsOf(std::vector<double> halves) {
  Uncertainty uncertainty;
  for (const double half : halves) uncertainty.standardError.push_back(half / 1.96);
  return uncertainty;
}

/// A servo's gain of 7 ± 0.5 beside an offset of 0.1 ± 0.01 and a rotor of 2 ± 0.25.
SearchResult offsetAndRotor() {
  SearchResult found;
  FitModel& model = found.final.fit.model;
  model.effects = {{"position_offset", "rig.shoulder", {}}, {"rotor_inertia", "rig.shoulder", {}}};
  model.parameters = {numberOf("p", -1, 1, 20), numberOf("offset_rad", 0, -1, 1), numberOf("inertia_kg_m2", 1, 0, 10)};
  model.values = {7, 0.1, 2};
  found.finalUncertainty = errorsOf({0.5, 0.01, 0.25});
  for (const PlacedEffect& effect : model.effects) {
    Found each;
    each.effect = effect;
    found.effects.push_back(each);
  }
  return found;
}

/// A payload in the place of the offset.
void addPayload(SearchResult& found, std::vector<double> values, std::vector<double> halves) {
  FitModel rival;
  rival.effects = {{"rotor_inertia", "rig.shoulder", {}}, {"payload", "rig.arm", {}}};
  rival.parameters = {numberOf("p", -1, 1, 20), numberOf("inertia_kg_m2", 0, 0, 10), numberOf("mass_kg", 1, 0, 5)};
  rival.values = std::move(values);
  found.effects[0].rivals.push_back({"payload", "rig.arm"});
  found.effects[0].rivalFits.push_back({rival, {}, 0});
  found.effects[0].rivalUncertainties.push_back(errorsOf(std::move(halves)));
}

void expectInterval(double low, double high, const GapReport::Interval& interval) {
  EXPECT_DOUBLE_EQ(low, interval.low);
  EXPECT_DOUBLE_EQ(high, interval.high);
}

TEST(RivalIntervals, ReachFromTheLowestToTheHighestEndOfAll) {
  SearchResult found = offsetAndRotor();
  addPayload(found, {9, 2.5, 0.3}, {0.25, 0.5, 0.1});
  expectInterval(6.5, 9.25, intervalAmongRivals(found, 0));
  // The rotor stands beside the payload, too, in another place of that model; its own interval is [1.75, 2.25].
  expectInterval(1.75, 3, intervalAmongRivals(found, 2));
  // With the payload there is no offset.
  EXPECT_FALSE(intervalAmongRivals(found, 1).known());
}

TEST(RivalIntervals, ARivalThatDoesNotTellANumberLeavesItsWholeRange) {
  SearchResult found = offsetAndRotor();
  addPayload(found, {9, 2.5, 0.3}, {infinity, 0.5, 0.1});
  expectInterval(1, 20, intervalAmongRivals(found, 0));
}

TEST(RivalIntervals, OfAllRivalsOfAllEffects) {
  SearchResult found = offsetAndRotor();
  addPayload(found, {9, 2.5, 0.3}, {0.25, 0.5, 0.1});
  addPayload(found, {4, 2.5, 0.3}, {0.5, 0.125, 0.1});
  expectInterval(3.5, 9.25, intervalAmongRivals(found, 0));
}

TEST(RivalIntervals, WithoutRivalsThereAreNone) { EXPECT_FALSE(intervalAmongRivals(offsetAndRotor(), 0).known()); }

// The same effect at another place is another effect.
TEST(RivalIntervals, AnotherPlaceIsAnotherEffect) {
  SearchResult found = offsetAndRotor();
  addPayload(found, {9, 2.5, 0.3}, {0.25, 0.5, 0.1});
  found.effects[0].rivalFits[0].model.effects[0].at = "rig.elbow";
  EXPECT_FALSE(intervalAmongRivals(found, 2).known());
}

TEST(RivalIntervals, StayInsideTheBounds) {
  SearchResult found = offsetAndRotor();
  found.finalUncertainty = errorsOf({30, 0.01, 0.25});
  const FitModel& model = found.final.fit.model;
  expectInterval(1, 20, interval95(model, found.finalUncertainty, 0));
  expectInterval(0.09, 0.11, interval95(model, found.finalUncertainty, 1));
}

}  // namespace
}  // namespace btr
