#pragma once
#include <QString>

#include "core/run/loop/back_to_reality.h"
#include "core/store/records.h"

namespace btr::ui {

/// How a run stands, seen from outside: what the record says, and whether a process really works on it.
enum class RunFace { ready, learning, waiting, adapting, stopping, interrupted, stopped, finished, failed };
RunFace faceOf(const RunRecord& run, bool active);

QString stageText(RunFace face, const RunProgress& progress);  ///< "L1 · learning", "Waiting for real fitness", …
/// For a narrow place: "L1 · learning", "Waiting", …
QString briefStageText(RunFace face, const RunProgress& progress);
QString iconName(RunFace face);  ///< a Breeze icon

/// Measured and wanted individuals of the stage that waits.
struct MeasuringCount {
  int settled = 0, wanted = 0;
  int iteration = 0;  ///< of L2; 0: the stage's own measurement
};
MeasuringCount countMeasured(const RunRecord& run, const std::vector<MeasurementTask>& tasks,
                             const std::vector<MeasurementRecord>& measurements);

/// What happens next, or what the user can do now, in one sentence.
QString nextAction(RunFace face, const RunRecord& run, const RunProgress& progress, const MeasuringCount& measuring,
                   bool active = false);
/// "Run 3 · seed 7".
QString runName(const RunRecord& run);
inline bool isStandIn(const RunRecord& run) { return run.reality == "stand_in"; }
inline bool isMeasuredByPerson(const RunRecord& run) { return run.reality == "person"; }

}  // namespace btr::ui
