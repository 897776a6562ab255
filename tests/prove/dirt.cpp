#include "tests/prove/dirt.h"

#include <algorithm>
#include <cmath>

#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr::prove {
namespace {

constexpr double mostOfPeriod = 0.45;  // stamps keep their order

/// A whole number for each sensor, the same for its columns; at least one sensor is slow.
std::vector<int> drawSlowness(const std::vector<int>& groups, Random& random) {
  std::vector<int> numbers;
  for (const int group : groups) numbers.resize(std::max(numbers.size(), static_cast<std::size_t>(group) + 1), 1);
  if (numbers.empty()) return {};
  const std::size_t slow = random.below(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (i == slow || random.chance(0.5)) numbers[i] = 2 + static_cast<int>(random.below(3));
  std::vector<int> byColumn;
  for (const int group : groups) byColumn.push_back(numbers[static_cast<std::size_t>(group)]);
  return byColumn;
}

}  // namespace

const std::vector<std::string>& dirtKinds() {
  static const std::vector<std::string> kinds{"quiet", "jitter", "stale", "multirate", "dropped", "mixed"};
  return kinds;
}

Dirt drawDirt(const std::string& kind, const std::vector<int>& groups, bool hasInputs, Random random) {
  const auto& known = dirtKinds();
  if (std::find(known.begin(), known.end(), kind) == known.end())
    throw InputError("--dirt", kind, "quiet, jitter, stale, multirate, dropped or mixed");
  const auto has = [&](const char* name) { return kind == name || (kind == "mixed" && random.chance(0.5)); };
  Dirt dirt;
  dirt.staleFor.assign(groups.size(), 1);
  dirt.everyNth.assign(groups.size(), 1);
  if (has("jitter")) dirt.jitter = random.uniform(0.03, 0.15);
  if (has("stale")) dirt.staleFor = drawSlowness(groups, random);
  if (has("multirate")) dirt.everyNth = drawSlowness(groups, random);
  // Of a value that is repeated and then left out nobody sees how old it is: that would be a lag, and no dirt.
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (dirt.staleFor[i] > 1) dirt.everyNth[i] = 1;
  if (has("dropped")) {
    dirt.lost = random.uniform(0.01, 0.1);
    dirt.losesRows = !hasInputs;
  }
  return dirt;
}

void soil(LoggedTrial& trial, const Dirt& dirt, double sample_s, Random random) {
  const std::size_t first = trial.firstMeasured;
  // What was measured at a row; every sensor has its own phase.
  for (std::size_t i = 0; i < dirt.staleFor.size(); ++i) {
    const auto nth = static_cast<std::size_t>(dirt.staleFor[i]);
    for (std::size_t row = 0; row < trial.rows.size(); ++row)
      if (row % nth != 0) trial.rows[row][first + i] = trial.rows[row - 1][first + i];
  }
  for (std::size_t i = 0; i < dirt.everyNth.size(); ++i) {
    const auto nth = static_cast<std::size_t>(dirt.everyNth[i]);
    for (std::size_t row = 0; row < trial.rows.size(); ++row)
      if (row % nth != 0) trial.rows[row][first + i].reset();
  }
  if (dirt.jitter > 0)
    for (std::size_t row = 1; row < trial.rows.size(); ++row)
      *trial.rows[row][0] += sample_s * std::clamp(dirt.jitter * random.normal(), -mostOfPeriod, mostOfPeriod);
  if (dirt.lost > 0) {
    std::vector<std::vector<std::optional<double>>> kept;
    // Losses come in bursts of one to five rows. The first row and the last always arrive.
    constexpr double usualBurst = 3;
    std::size_t losing = 0;
    for (std::size_t row = 0; row < trial.rows.size(); ++row) {
      if (losing == 0 && random.chance(dirt.lost / usualBurst)) losing = 1 + random.below(5);
      const bool lost = losing > 0 && row > 0 && row + 1 < trial.rows.size();
      if (losing > 0) --losing;
      if (lost && dirt.losesRows) continue;
      kept.push_back(trial.rows[row]);
      if (lost)
        for (std::size_t column = first; column < trial.columns.size(); ++column) kept.back()[column].reset();
    }
    trial.rows = std::move(kept);
  }
}

void spoil(LoggedTrial& trial, const std::vector<double>& noises, Random random) {
  const std::size_t column = random.below(noises.size()), rows = trial.rows.size();
  const auto begins = static_cast<std::size_t>(random.uniform(0.2, 0.7) * static_cast<double>(rows));
  const double most = (random.chance(0.5) ? 1 : -1) * random.uniform(15, 60) * noises[column];
  const bool slips = random.chance(0.5);
  for (std::size_t row = begins; row < rows; ++row) {
    const double share = slips ? 1 : static_cast<double>(row - begins) / static_cast<double>(rows - begins);
    if (auto& cell = trial.rows[row][trial.firstMeasured + column]) *cell += most * share;
  }
}

std::string csvOf(const LoggedTrial& trial) {
  std::string text;
  for (std::size_t i = 0; i < trial.columns.size(); ++i) text += (i == 0 ? "" : ",") + trial.columns[i];
  text += "\n";
  for (const auto& row : trial.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ",";
      if (row[i]) text += toText(i == 0 ? std::round(1e6 * *row[i]) / 1e6 : *row[i]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace btr::prove
