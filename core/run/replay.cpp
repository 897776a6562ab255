#include "core/run/replay.h"

#include "core/run/setup/prepared_experiment.h"

namespace btr {

std::vector<Replay::Robot> robotsOf(const Scene& scene) {
  std::vector<Replay::Robot> robots;
  for (const SceneRobot& robot : scene.robots)
    robots.push_back({robot.name, std::make_shared<const RobotModel>(robot.model), robot.start});
  return robots;
}

Replay replay(const Database& database, const PluginHost& host, Id run, Id individual) {
  const PreparedExperiment prepared = prepareFromRun(database.run(run), host);
  const IndividualRecord stored = database.individual(individual);
  const Scene scene = prepared.scene(database.simulator(stored.simulator).simulator);
  Replay replay;
  replay.result = prepared.trial(scene, stored.parameters, stored.trialSeed, true);
  replay.fitness = prepared.fitnessOf(replay.result);
  replay.storedFitness = stored.fitness;
  replay.sha256 = replay.result.trace.sha256();
  replay.storedSha256 = stored.traceSha256;
  replay.identical =
      replay.fitness == replay.storedFitness && (replay.storedSha256.empty() || replay.sha256 == replay.storedSha256);
  replay.robots = robotsOf(scene);
  return replay;
}

}  // namespace btr
