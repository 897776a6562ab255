#include "ui/controllers/replay_controller.h"

#include <array>

#include "core/run/grid/grid_cells.h"
#include "core/run/grid/grid_kicks.h"
#include "core/run/replay.h"
#include "core/spec/scene_spec.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/run_text.h"
#include "ui/gap/gap_page.h"
#include "ui/gap/ghost_replay.h"
#include "ui/gap/report_view.h"
#include "ui/scene3d/replay_job.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {

ReplayController::ReplayController(Workbench& bench, ReplayPanel& panel, IndividualsTable& individuals,
                                   GapPage& reports)
    : QObject(&bench),
      bench_(bench),
      panel_(panel),
      individuals_(individuals),
      reports_(reports),
      job_(new ReplayJob(this)) {
  panel_.attach(*job_);
  connect(&bench_, &Workbench::replayWanted, this, &ReplayController::replay);
  connect(&individuals_, &IndividualsTable::replayRequested, this, &ReplayController::replay);
  connect(&individuals_, &IndividualsTable::pairRequested, this, &ReplayController::replayPair);
  connect(&reports_, &GapPage::timeChosen, this, &ReplayController::showGhosts);
}

// Made again in a thread of its own, from a connection of its own.
std::function<ReplayData(Id)> ReplayController::replayer() const {
  return [path = bench_.path().toStdString(), run = bench_.run().id, host = bench_.host(),
          hidden = individuals_.model().hidden()](Id individual) {
    const Database database = Database::open(path, Database::Mode::readOnly);
    const RunRecord record = database.run(run);
    const IndividualRecord stored = database.individual(individual);
    const ExperimentSpec spec = experimentFromJson(record.specJson, "run " + std::to_string(run), "");
    const QString unit = QString::fromStdString(host->fitness(spec.fitness.name)->unit());
    std::vector<ReplayBall> balls;
    for (const BallSpec& ball : sceneFromJson(record.sceneJson, "scene", "").balls)
      balls.push_back({ball.name, ball.radius_m});
    ReplayData shown =
        toReplayData(btr::replay(database, *host, run, individual), balls,
                     tr("run %1, generation %2, individual %3").arg(run).arg(stored.generation).arg(individual), unit);
    shown.simulator = tr("simulator %1").arg(database.simulator(stored.simulator).number);
    shown.standIn = isStandIn(record);
    shown.fitnessHidden = hidden.contains(individual) || hidden.contains(stored.sameAs);
    return shown;
  };
}

void ReplayController::replay(Id individual) {
  if (!bench_.watcher().isOpen() || bench_.run().id == 0) return;
  emit bench_.dockWanted("replay");
  ghosts_ = {};
  individuals_.select(individual);
  job_->start([once = replayer(), individual] { return once(individual); });
}

void ReplayController::replayPair(Id first, Id second) {
  if (!bench_.watcher().isOpen() || bench_.run().id == 0) return;
  emit bench_.dockWanted("replay");
  ghosts_ = {};
  job_->start([once = replayer(), first, second] {
    ReplayData shown = once(first);
    shown.beside = std::make_shared<const ReplayData>(once(second));
    return shown;
  });
}

void ReplayController::replayBest() {
  const RunRecord& run = bench_.run();
  if (!bench_.watcher().isOpen() || run.generation == 0) return;
  bench_.reader().read(
      this, "best", tr("the best of run %1").arg(run.id),
      [id = run.id, generation = run.generation](const Database& database) {
        return database.bestIndividuals(id, 1, generation, generation);
      },
      [this, id = run.id](const std::vector<IndividualRecord>& best) {
        if (!best.empty() && id == bench_.run().id) replay(best.front().id);
      });
}

void ReplayController::playKick(Id grid, double distance_m, double bearing_rad, double direction_rad) {
  if (!bench_.watcher().isOpen()) return;
  emit bench_.dockWanted("replay");
  ghosts_ = {};
  const std::array<double, 3> point{distance_m, bearing_rad, direction_rad};
  job_->start([path = bench_.path().toStdString(), grid, point, host = bench_.host()] {
    const Database database = Database::open(path, Database::Mode::readOnly);
    const GridKick kick = gridKick(database, *host, grid, point);
    std::vector<ReplayBall> balls;
    for (const BallSpec& ball : kick.balls) balls.push_back({ball.name, ball.radius_m});
    ReplayData shown =
        toReplayData(kick.replay, balls,
                     tr("grid %1, interpolated: %2").arg(grid).arg(QString::fromStdString(nameOfTask(point))), tr("m"));
    shown.check = ReplayData::Check::notChecked;
    return shown;
  });
}

// The chosen trial in 3D, in the scene that the report was made with; else the pane says why not.
void ReplayController::showGhosts(std::size_t trial, double time_s) {
  if (const std::pair wanted(reports_.view().report(), trial); ghosts_ != wanted) {
    bench_.guard([&] {
      ghosts_ = wanted;
      const ReportScene known = sceneOf(*wanted.first);
      if (!known.problem.isEmpty()) return panel_.showMessage(known.problem);
      const auto shown = ghostTrial(*wanted.first, trial, known.scene, known.models);
      if (!shown) return panel_.showMessage(tr("Nothing of the report's scene was recorded in this trial."));
      panel_.setReplay(shown->recorded);
      panel_.setGhosts(shown->ghosts);
    });
  }
  panel_.showTime(time_s);
}

}  // namespace btr::ui
