#include "core/gap/proof/proof_score.h"
#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proved_case.h"
#include "core/spec/figures.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>
#include <limits>

namespace btr {
namespace {

using Binomial = boost::math::binomial_distribution<double>;
constexpr double tail = 0.025;

std::string foundText(const Share& share) {
  return tenthPercent(share.value()) + " (" + std::to_string(share.hits) + " of " + std::to_string(share.cases) + "; " +
         tenthPercent(share.low()) + " to " + tenthPercent(share.high()) + ")";
}

ProofBar atLeast(const std::string& question, const Share& share, double wanted) {
  return {question, "at least " + tenthPercent(wanted), share.cases ? foundText(share) : "no such case",
          share.cases > 0, share.cases > 0 && share.value() >= wanted};
}

ProofBar atMost(const std::string& question, const Share& share, double wanted) {
  return {question, "at most " + tenthPercent(wanted), share.cases ? foundText(share) : "no such case", share.cases > 0,
          share.cases > 0 && share.value() <= wanted};
}

std::vector<ProofBar> barsOf(const ProofGroup& all) {
  std::vector<ProofBar> bars{
      atLeast("One effect above three noise floors is named, itself or among two rivals", all.named, 0.95),
      atLeast("Both of two effects above three noise floors are named", all.bothNamed, 0.85),
      atLeast("The place is right", all.location, 0.97),
      atMost("False alarms where nothing is missing", all.falseAlarms, 0.02),
      atLeast("Error in recordings never given to the analysis at most 1.5 times the noise floor", all.heldOutNear,
              0.90),
      atMost("An effect from outside the library gets a confident wrong name", all.confidentlyWrong, 0.05)};
  const double error = middleOf(all.parameterErrors);
  const bool asked = !all.parameterErrors.empty();
  bars.insert(
      bars.begin() + 5,
      {"Parameters of the effects named, median error", "at most " + tenthPercent(0.1),
       asked ? tenthPercent(error) + " (" + std::to_string(all.parameterErrors.size()) + " values)" : "no such case",
       asked, asked && error <= 0.1});
  // The issue asks for at least 200 cases with nothing missing and 400 in all.
  const int healthy = all.falseAlarms.cases;
  bars.push_back({"Cases in all, and with nothing missing", "at least 400 and 200",
                  std::to_string(all.cases) + " and " + std::to_string(healthy), true,
                  all.cases >= 400 && healthy >= 200});
  return bars;
}

template <class Groups>
ProofGroup& groupOf(Groups& groups, const std::string& name) {
  for (auto& [other, group] : groups)
    if (other == name) return group;
  groups.emplace_back(name, ProofGroup{});
  return groups.back().second;
}

std::string costClass(double cost) {
  return cost <= 3 ? "up to 3" : cost <= 10 ? "3 to 10" : cost <= 30 ? "10 to 30" : "above 30";
}

void append(std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

double Share::low() const { return hits > 0 ? Binomial::find_lower_bound_on_p(cases, hits, tail) : 0; }
double Share::high() const { return hits < cases ? Binomial::find_upper_bound_on_p(cases, hits, tail) : 1; }

double middleOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void ProofGroup::add(const ProvedCase& proved, const CaseMarks& marks) {
  const auto count = [](Share& share, const std::optional<bool>& hit) {
    if (hit) share.count(*hit);
  };
  ++cases;
  failed += !proved.failure.empty();
  count(falseAlarms, marks.falseAlarm);
  count(named, marks.named);
  count(alone, marks.alone);
  count(bothNamed, marks.bothNamed);
  count(location, marks.location);
  count(heldOutNear, marks.heldOutNear);
  count(confidentlyWrong, marks.confidentlyWrong);
  count(unexplained, marks.unexplained);
  count(numbersChanged, marks.numbersChanged);
  for (const bool covered : marks.parametersCovered) parametersCovered.count(covered);
  for (const bool covered : marks.calibratedCovered) calibratedCovered.count(covered);
  for (const bool covered : marks.parametersAmongRivals) parametersAmongRivals.count(covered);
  for (const bool covered : marks.calibratedAmongRivals) calibratedAmongRivals.count(covered);
  if (marks.heldOut && proved.answer.kind != "outside") heldOut.push_back(*marks.heldOut);
  append(parameterErrors, marks.parameterErrors);
  append(calibratedErrors, marks.calibratedErrors);
  if (proved.failure.empty()) seconds.push_back(proved.seconds);
}

ProofScore score(const std::vector<ProvedCase>& cases) {
  ProofScore total;
  // A fixed order, whatever case comes first.
  for (const char* name : {"pendulum", "leg", "carpet", "flight", "walk"}) groupOf(total.byScene, name);
  for (const char* name : {"nothing", "parameters", "one", "two", "outside"}) groupOf(total.byKind, name);
  for (const char* name : {"up to 3", "3 to 10", "10 to 30", "above 30"}) groupOf(total.byCost, name);
  for (const ProvedCase& proved : cases) {
    const CaseMarks marks = mark(proved);
    total.all.add(proved, marks);
    groupOf(total.byScene, proved.answer.scene).add(proved, marks);
    groupOf(total.byKind, proved.answer.kind).add(proved, marks);
    double cost = 0;
    for (const auto& hidden : proved.answer.hidden) cost = std::max(cost, hidden.cost);
    if (cost > 0) groupOf(total.byCost, costClass(cost)).add(proved, marks);
    for (const auto& pair : marks.confused) ++total.confusion[pair];
    ++total.verdicts[{proved.answer.kind, proved.failure.empty() ? proved.verdict : "failed"}];
  }
  for (auto* groups : {&total.byScene, &total.byKind, &total.byCost})
    std::erase_if(*groups, [](const auto& entry) { return entry.second.cases == 0; });
  total.bars = barsOf(total.all);
  return total;
}

}  // namespace btr
