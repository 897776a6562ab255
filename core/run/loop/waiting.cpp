#include "core/run/loop/waiting.h"

#include <algorithm>

#include "core/run/reality/reality_gap.h"

namespace btr {
namespace {

const std::string waits = " wait for real fitness";
const std::string allVoid = ": all values are void; enter at least one that is not";

std::string placeOf(int stage, int iteration) {
  return iteration > 0 ? "L2 in stage " + std::to_string(stage) + ", iteration " + std::to_string(iteration)
                       : "measurement stage " + std::to_string(stage);
}

}  // namespace

std::string waitingText(int stage, int iteration, int missing, int all, bool anyCounts) {
  const std::string who = iteration > 0 ? " policies" : " individuals";
  if (missing > 0)
    return placeOf(stage, iteration) + ": " + std::to_string(missing) + " of " + std::to_string(all) + who + waits;
  return anyCounts ? "" : placeOf(stage, iteration) + allVoid;
}

std::string messageNow(const Database& database, const RunRecord& run) {
  if (run.state != RunState::waiting || run.message.find(waitForRecording) != std::string::npos) return run.message;
  const int stage = run.stage + 1;
  std::vector<MeasurementTask> tasks = database.measurementTasks(run.id, stage);
  const int iteration = tasks.empty() ? 0 : tasks.back().iteration;
  std::erase_if(tasks, [&](const MeasurementTask& task) { return task.iteration != iteration; });
  const std::vector<MeasurementRecord> measured = database.measurements(run.id);
  const bool ofFitness = run.message.ends_with(waits) || run.message.ends_with(allVoid) ||
                         run.message.starts_with("waits for real fitness");
  const auto isNew = [&](const MeasurementRecord& m) { return m.enteredAt > run.updatedAt; };
  if (!ofFitness && std::ranges::none_of(measured, isNew)) return run.message;
  const auto all = static_cast<int>(tasks.size());
  const auto missing = static_cast<int>(
      std::ranges::count_if(tasks, [&](const MeasurementTask& task) { return !isSettled(task, measured); }));
  const std::string text = waitingText(stage, iteration, missing, all, !realFitness(tasks, measured, stage).empty());
  return text.empty() ? placeOf(stage, iteration) + ": all values are entered; btr run goes on" : text;
}

}  // namespace btr
