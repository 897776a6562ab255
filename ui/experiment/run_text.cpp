#include "ui/experiment/run_text.h"

#include <QCoreApplication>
#include <algorithm>

namespace btr::ui {
namespace {

struct RunTexts {
  Q_DECLARE_TR_FUNCTIONS(run)
};

QString generations(int count) {
  return count == 1 ? RunTexts::tr("1 generation") : RunTexts::tr("%1 generations").arg(count);
}

// What a waiting run needs next, a clause.
QString whoMeasures(const RunRecord& run) {
  if (isMeasuredByPerson(run))
    return RunTexts::tr("Measure on the real robot and enter the values in the measurement sheet");
  return RunTexts::tr("“%1” measures; press Continue to ask it again").arg(QString::fromStdString(run.reality));
}

}  // namespace

RunFace faceOf(const RunRecord& run, bool active) {
  if (active && run.stopRequested) return RunFace::stopping;
  switch (run.state) {
    case RunState::ready:
      return active ? RunFace::learning : RunFace::ready;
    case RunState::learning:
      return active ? RunFace::learning : RunFace::interrupted;
    case RunState::adapting:
      return active ? RunFace::adapting : RunFace::interrupted;
    case RunState::waiting:
      return RunFace::waiting;
    case RunState::stopped:
      return active ? RunFace::learning : RunFace::stopped;
    case RunState::finished:
      return RunFace::finished;
    case RunState::failed:
      return RunFace::failed;
  }
  return RunFace::failed;
}

QString stageText(RunFace face, const RunProgress& progress) {
  switch (face) {
    case RunFace::ready:
      return RunTexts::tr("Ready to start");
    case RunFace::learning:
      return progress.stage == "L3"   ? RunTexts::tr("L3 · adapting the simulator")
             : progress.stage == "L2" ? RunTexts::tr("L2 · learning in reality")
                                      : RunTexts::tr("L1 · learning in simulation");
    case RunFace::adapting:
      return RunTexts::tr("L3 · adapting the simulator");
    case RunFace::waiting:
      return progress.stage == "L3" ? RunTexts::tr("Waiting for real fitness · L3 adapts the simulator meanwhile")
                                    : RunTexts::tr("Waiting for real fitness");
    case RunFace::stopping:
      return RunTexts::tr("Stopping …");
    case RunFace::interrupted:
      return RunTexts::tr("Interrupted");
    case RunFace::stopped:
      return RunTexts::tr("Stopped");
    case RunFace::finished:
      return RunTexts::tr("Finished");
    case RunFace::failed:
      return RunTexts::tr("Failed");
  }
  return {};
}

QString briefStageText(RunFace face, const RunProgress& progress) {
  const QString whole = stageText(face, progress);
  switch (face) {
    case RunFace::learning:
    case RunFace::adapting:
      return whole.section(' ', 0, 2);  // "L1 · learning"
    case RunFace::waiting:
      return RunTexts::tr("Waiting");
    default:
      return whole;
  }
}

QString iconName(RunFace face) {
  switch (face) {
    case RunFace::ready:
      return "media-playback-start";
    case RunFace::learning:
      return "view-refresh";
    case RunFace::adapting:
      return "configure";
    case RunFace::waiting:
      return "clock";
    case RunFace::stopping:
      return "media-playback-stop";
    case RunFace::interrupted:
      return "media-playback-pause";
    case RunFace::stopped:
      return "media-playback-stop";
    case RunFace::finished:
      return "emblem-checked";
    case RunFace::failed:
      return "emblem-error";
  }
  return {};
}

MeasuringCount countMeasured(const RunRecord& run, const std::vector<MeasurementTask>& tasks,
                             const std::vector<MeasurementRecord>& measurements) {
  MeasuringCount count;
  // Of L2 the iteration that was begun last; the earlier ones are settled.
  for (const MeasurementTask& task : tasks)
    if (task.stage == run.stage + 1) count.iteration = std::max(count.iteration, task.iteration);
  for (const MeasurementTask& task : tasks) {
    if (task.stage != run.stage + 1 || task.iteration != count.iteration) continue;
    ++count.wanted;
    int values = 0;  // a void value settles too: the individual was tried
    for (const MeasurementRecord& measurement : measurements) values += measurement.individual == task.individual;
    if (values >= task.wantedRepeats) ++count.settled;
  }
  return count;
}

QString nextAction(RunFace face, const RunRecord& run, const RunProgress& progress, const MeasuringCount& measuring,
                   bool active) {
  switch (face) {
    case RunFace::ready:
      return RunTexts::tr("Press Start: the learner begins with its first generation.");
    case RunFace::learning:
    case RunFace::adapting:
      if (face == RunFace::adapting || progress.stage == "L3")
        return progress.totalGenerations > 0 && run.generation >= progress.totalGenerations
                   ? RunTexts::tr("Then the new simulator version is stored, and the run is finished.")
                   : RunTexts::tr("Then the new simulator version is stored and learning goes on in it.");
      if (progress.stage == "L2") return RunTexts::tr("Then the step is taken, and the next policies are proposed.");
      if (progress.stageTotal > progress.stageDone && progress.generation < progress.totalGenerations)
        return (isStandIn(run) ? RunTexts::tr("In %1 the best are measured by the stand-in reality.")
                               : RunTexts::tr("In %1 the best wait for real fitness."))
            .arg(generations(progress.stageTotal - progress.stageDone));
      return RunTexts::tr("Learning goes on in simulation.");
    case RunFace::waiting:
      if (isStandIn(run))
        return RunTexts::tr("The stand-in reality answers the measurements; press Continue if nothing happens.");
      if (active && measuring.settled >= measuring.wanted)
        return RunTexts::tr("All %1 are measured: the run goes on by itself.").arg(measuring.wanted);
      if (measuring.wanted > 0 && measuring.settled >= measuring.wanted)
        return (measuring.iteration > 0 ? RunTexts::tr("All %1 are measured: press Continue to take the step.")
                                        : RunTexts::tr("All %1 are measured: press Continue to adapt the simulator."))
            .arg(measuring.wanted);
      return RunTexts::tr("%1 (%2 of %3 done).").arg(whoMeasures(run)).arg(measuring.settled).arg(measuring.wanted);
    case RunFace::stopping:
      return RunTexts::tr("The running trials end, then everything is stored.");
    case RunFace::interrupted:
      return RunTexts::tr("No process works on it. Press Continue: it goes on with the same bits.");
    case RunFace::stopped:
      return RunTexts::tr("Press Continue: it goes on exactly where it stopped.");
    case RunFace::finished:
      return RunTexts::tr("Nothing is left to do. Replay the best individuals or export the tables.");
    case RunFace::failed:
      return RunTexts::tr("Read the message; Continue tries again from the last stored generation.");
  }
  return {};
}

QString runName(const RunRecord& run) { return RunTexts::tr("Run %1 · seed %2").arg(run.id).arg(run.seed); }

}  // namespace btr::ui
