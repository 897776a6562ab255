#include "core/run/comparison.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/run/export.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"

namespace btr {
namespace {

const StageOutcome* atStage(const std::vector<StageOutcome>& run, int stage) {
  const auto found = std::ranges::find(run, stage, &StageOutcome::stage);
  return found == run.end() ? nullptr : &*found;
}

/// A run may have passed a stage in which nobody was left to measure.
std::vector<int> commonStages(const std::vector<std::vector<StageOutcome>>& runs) {
  std::vector<int> stages;
  if (runs.empty()) return stages;
  for (const StageOutcome& outcome : runs.front())
    if (std::ranges::all_of(runs, [&](const auto& run) { return atStage(run, outcome.stage); }))
      stages.push_back(outcome.stage);
  return stages;
}

}  // namespace

std::vector<StageOutcome> stageOutcomes(const Database& database, Id run) {
  const std::vector<MeasurementTask> tasks = database.measurementTasks(run);
  const std::vector<MeasurementRecord> measurements = database.measurements(run);
  std::vector<StageOutcome> outcomes;
  for (const GapRecord& record : database.gaps(run)) {
    StageOutcome outcome;
    outcome.stage = record.stage;
    outcome.adapted = record.newAfter;
    std::vector<double> real, simulated;
    for (const RealFitness& r : realFitness(tasks, measurements, record.stage)) {
      // The stage's own individuals, without those that L2 tried.
      if (r.stage != record.stage || r.iteration != 0) continue;
      real.push_back(r.mean);
      simulated.push_back(std::ranges::find(tasks, r.individual, [](const MeasurementTask& t) {
                            return t.individual;
                          })->simulatedFitness);
    }
    if (real.empty()) continue;
    outcome.gap = gapOf(real, simulated, GapNorm::meanAbsolute);
    outcome.realMean = spreadOf(real).mean;
    outcome.realBest = *std::ranges::max_element(real);
    outcomes.push_back(outcome);
  }
  return outcomes;
}

void compareArms(std::vector<ComparedArm>& arms) {
  for (ComparedArm& arm : arms) {
    arm.stages.clear();
    const std::vector<std::vector<StageOutcome>>& base = arms.front().runs;
    for (const int number : commonStages(arm.runs)) {
      const auto over = [&](double StageOutcome::*what) {
        std::vector<double> values;
        for (const auto& run : arm.runs) values.push_back(atStage(run, number)->*what);
        return spreadOf(values);
      };
      const auto difference = [&](double StageOutcome::*what) {
        std::vector<double> values;
        for (std::size_t k = 0; k < std::min(arm.runs.size(), base.size()) && &arm != &arms.front(); ++k)
          if (const StageOutcome* other = atStage(base[k], number))
            values.push_back(atStage(arm.runs[k], number)->*what - other->*what);
        return spreadOf(values);
      };
      ComparedStage stage;
      stage.stage = number;
      stage.gap = over(&StageOutcome::gap);
      stage.adapted = over(&StageOutcome::adapted);
      stage.realMean = over(&StageOutcome::realMean);
      stage.realBest = over(&StageOutcome::realBest);
      stage.gapDifference = difference(&StageOutcome::gap);
      stage.realDifference = difference(&StageOutcome::realMean);
      arm.stages.push_back(stage);
    }
  }
}

ComparedExperiments loadArms(const ComparisonSpec& spec, const PluginHost& host) {
  ComparedExperiments loaded;
  for (std::size_t i = 0; i < spec.arms.size(); ++i) {
    const std::string place = spec.place + " /arms/" + std::to_string(i) + "/experiment: ";
    try {
      loaded.experiments.push_back(
          loadExperiment((std::filesystem::path(spec.directory) / spec.arms[i].experiment).string()));
      const std::string unit = prepareFromFiles(loaded.experiments.back(), host).fitness->unit();
      if (i == 0) loaded.unit = unit;
      if (unit != loaded.unit)
        throw InputError(spec.arms[i].experiment + " /fitness: its unit is \"" + unit +
                         "\", that of the first arm is \"" + loaded.unit +
                         "\"; the arms of a comparison need one unit");
    } catch (const InputError& error) {
      throw InputError(place + error.what());
    }
  }
  return loaded;
}

Comparison runComparison(Database& database, const PluginHost& host, const ComparisonSpec& spec,
                         const ComparedExperiments& loaded, const StopFlag& stop, const RunOptions& options,
                         const std::function<void(const std::string& arm, std::uint64_t seed)>& began) {
  Comparison all;
  all.name = spec.name;
  all.seeds = spec.seeds;
  all.unit = loaded.unit;
  for (const ComparisonSpec::Arm& arm : spec.arms) {
    all.arms.push_back({arm.name, {}, {}});
    all.runs.emplace_back();
  }
  // Seed by seed: a comparison that is stopped has whole pairs.
  for (const std::uint64_t seed : spec.seeds)
    for (std::size_t a = 0; a < spec.arms.size() && all.end != RunEnd::stopped; ++a) {
      const Id run = startRun(database, host, loaded.experiments[a], seed);
      if (began) began(spec.arms[a].name, seed);
      const RunEnd end = continueRun(database, host, run, stop, options);
      if (end != RunEnd::finished) all.end = end;
      all.runs[a].push_back(run);
      all.arms[a].runs.push_back(stageOutcomes(database, run));
    }
  compareArms(all.arms);
  return all;
}

std::string toCsv(const Comparison& comparison) {
  const std::string unit = unitSuffix(comparison.unit);
  std::string text = "arm,stage,seeds";
  for (const char* name : {"gap", "adapted_gap", "real_mean", "real_best", "gap_difference", "real_difference"})
    text += "," + std::string(name) + unit + "," + name + "_ci95_half" + unit;
  text += '\n';
  for (const ComparedArm& arm : comparison.arms)
    for (const ComparedStage& stage : arm.stages) {
      std::string name;
      for (const char c : arm.name) name += c == '"' ? std::string("\"\"") : std::string(1, c);
      text += '"' + name + "\"," + std::to_string(stage.stage) + "," + std::to_string(stage.gap.count);
      for (const Spread* s :
           {&stage.gap, &stage.adapted, &stage.realMean, &stage.realBest, &stage.gapDifference, &stage.realDifference})
        text += s->count == 0 ? std::string(",,") : "," + toText(s->mean) + "," + toText(s->halfWidth95);
      text += '\n';
    }
  return text;
}

std::string toJsonText(const Comparison& comparison) {
  using nlohmann::json;
  const auto spread = [](const Spread& s) -> json {
    if (s.count == 0) return nullptr;
    return {{"mean", s.mean}, {"ci95_half", s.halfWidth95}, {"deviation", s.deviation}, {"count", s.count}};
  };
  json arms = json::array();
  for (std::size_t a = 0; a < comparison.arms.size(); ++a) {
    json stages = json::array(), runs = json::array();
    for (const ComparedStage& s : comparison.arms[a].stages)
      stages.push_back({{"stage", s.stage},
                        {"gap", spread(s.gap)},
                        {"adapted_gap", spread(s.adapted)},
                        {"real_mean", spread(s.realMean)},
                        {"real_best", spread(s.realBest)},
                        {"gap_difference", spread(s.gapDifference)},
                        {"real_difference", spread(s.realDifference)}});
    for (std::size_t k = 0; k < comparison.arms[a].runs.size(); ++k) {
      json each = json::array();
      for (const StageOutcome& o : comparison.arms[a].runs[k])
        each.push_back({{"stage", o.stage},
                        {"gap", o.gap},
                        {"adapted_gap", o.adapted},
                        {"real_mean", o.realMean},
                        {"real_best", o.realBest}});
      runs.push_back({{"run", comparison.runs[a][k]}, {"seed", comparison.seeds[k]}, {"stages", each}});
    }
    arms.push_back({{"name", comparison.arms[a].name}, {"stages", stages}, {"runs", runs}});
  }
  return json{{"format", "uchilsim-compared-1"},
              {"name", comparison.name},
              {"unit", comparison.unit},
              {"finished", comparison.end == RunEnd::finished},
              {"arms", arms}}
      .dump(1);
}

}  // namespace btr
