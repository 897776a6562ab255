#include "core/live/moment_experiment.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/live/moment.h"
#include "core/live/session.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d vectorFrom(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
std::array<double, 3> arrayFrom(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

template <class Spec>
Isometry3d poseFrom(const Spec& spec) {
  const auto& q = spec.orientation_wxyz;
  return Eigen::Translation3d(vectorFrom(spec.position_m)) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

/// Of a robot or an obstacle.
template <class Spec>
void moveBy(Spec& spec, const Isometry3d& by) {
  const Isometry3d pose = by * poseFrom(spec);
  const Eigen::Quaterniond q(pose.linear());
  spec.position_m = arrayFrom(pose.translation());
  spec.orientation_wxyz = {q.w(), q.x(), q.y(), q.z()};
}

/// Velocity and spin of anything.
template <class Spec>
void turnMotion(Spec& spec, const Isometry3d& by) {
  spec.velocity_m_s = arrayFrom(by.linear() * vectorFrom(spec.velocity_m_s));
  spec.spin_rad_s = arrayFrom(by.linear() * vectorFrom(spec.spin_rad_s));
}

/// The scene with this robot first, on the z axis, looking along x.
SceneSpec seenFrom(SceneSpec scene, std::size_t robot) {
  std::rotate(scene.robots.begin(), scene.robots.begin() + static_cast<std::ptrdiff_t>(robot),
              scene.robots.begin() + static_cast<std::ptrdiff_t>(robot) + 1);
  const RobotSpec& first = scene.robots.front();
  if (first.base != "free" || !scene.floor) return scene;
  const Isometry3d pose = poseFrom(first);
  const double heading = std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
  const Isometry3d by = Eigen::AngleAxisd(-heading, Vector3d::UnitZ()) *
                        Eigen::Translation3d(-pose.translation().x(), -pose.translation().y(), 0);
  for (RobotSpec& each : scene.robots) {
    moveBy(each, by);
    turnMotion(each, by);
  }
  for (BallSpec& ball : scene.balls) {
    ball.position_m = arrayFrom(by * vectorFrom(ball.position_m));
    turnMotion(ball, by);
  }
  for (ObstacleSpec& obstacle : scene.obstacles) {
    moveBy(obstacle, by);
    turnMotion(obstacle, by);
  }
  return scene;
}

std::size_t learnerOf(const Session& session, const std::string& wanted) {
  const Game& game = session.game();
  if (game.scene.robots.empty())
    throw InputError("robots", "none at this moment", "a robot that learns: add one first");
  std::optional<std::size_t> moved;
  for (std::size_t i = 0; i < game.scene.robots.size(); ++i) {
    const std::string& name = game.scene.robots[i].name;
    if (name == wanted) return i;
    const auto player = game.robots.find(name);
    if (!moved && player != game.robots.end() && player->second.hasPlugin()) moved = i;
  }
  if (!wanted.empty()) throw InputError("robot", "\"" + wanted + "\"", "a robot of this game");
  return moved.value_or(0);
}

/// The named ones first, as far as they are there, then all others.
std::vector<std::string> inOrder(std::vector<std::string> first, const std::vector<std::string>& all) {
  std::erase_if(first, [&](const std::string& name) { return std::ranges::find(all, name) == all.end(); });
  for (const std::string& name : all)
    if (std::ranges::find(first, name) == first.end()) first.push_back(name);
  return first;
}

/// What such a motion is for.
std::vector<std::string> fitnessesFor(const std::string& controller) {
  if (controller == "kick") return {"kick_distance"};
  return {"walk_speed", "kick_distance"};
}

/// Fills in controller, fitness and how long a trial takes. Throws InputError where the scene is not enough for it.
void choose(ExperimentSpec& experiment, const GameController& wanted, const Scene& scene, const PluginHost& host) {
  const auto controller = host.controller(wanted.plugin);
  const std::vector<Parameter> genotype = controller->genotype();
  if (genotype.empty() || controller->looks() || !controller->paths().empty())
    throw InputError("controller", wanted.plugin, "a controller whose parameters can be learned in trials");
  Scene arranged = scene;
  controller->arrange(arranged, wanted.settings);
  std::string fitness;
  for (const std::string& name : inOrder(fitnessesFor(wanted.plugin), host.fitnesses())) {
    try {
      host.fitness(name)->check(arranged);
    } catch (const InputError&) {
      continue;  // it measures what this scene does not have
    }
    fitness = name;
    break;
  }
  if (fitness.empty()) throw InputError("fitness", "none", "a fitness that this scene is enough for");
  const double trial_s = find(stageParameters(), "trial_maximum_s")->byDefault;
  Values settings = wanted.settings;
  const std::vector<double> parameters = resolve(genotype, wanted.parameters, "parameters");
  const auto duration_s = [&] { return controller->begin(arranged, settings, parameters)->duration(); };
  // In a game a motion goes on for as long as the game does.
  if (duration_s() > trial_s) settings.erase("duration_s");
  experiment.controller = choiceOf(wanted.plugin, settings, controller->settings());
  experiment.fitness.name = fitness;
  if (const double motion_s = duration_s(); motion_s > trial_s) experiment.stages["trial_maximum_s"] = motion_s;
  if (!wanted.parameters.empty()) experiment.start = SearchStart{wanted.parameters};
}

std::string firstName(const std::vector<std::string>& names) { return names.empty() ? std::string() : names.front(); }

}  // namespace

MomentExperiment experimentOf(const Session& session, const PluginHost& host, const std::string& robot) {
  const std::size_t index = learnerOf(session, robot);
  const Game& game = session.game();
  const std::string name = game.scene.robots[index].name;
  MomentExperiment moment;
  moment.scene = seenFrom(momentOf(session), index);
  ExperimentSpec& experiment = moment.experiment;
  experiment.name = name + " from " + toText(std::round(1000 * session.time_s()) / 1000) + " s on";
  experiment.simulator = game.simulator;
  experiment.stages["begins"] = 1;  // as the scene says, which is this moment
  experiment.learner.name = experiment.adaptation.name = firstName(inOrder({"ga"}, host.learners()));

  std::vector<GameController> candidates;
  if (const auto player = game.robots.find(name); player != game.robots.end()) {
    if (player->second.simulator) experiment.simulator = *player->second.simulator;
    if (player->second.hasPlugin()) candidates.push_back(*player->second.controller);
  }
  for (const std::string& plugin : inOrder({"kick", "walk"}, host.controllers()))
    candidates.push_back(GameController{plugin, {}, {}});
  const Scene scene = makeScene(moment.scene, loadModels(moment.scene), experiment.simulator, host.effectFactory());
  for (const GameController& candidate : candidates) {
    try {
      choose(experiment, candidate, scene, host);
      return moment;
    } catch (const InputError&) {
      continue;  // another one may do
    }
  }
  throw InputError("robot", name, "a robot that a controller with parameters can move in this scene");
}

void writeExperiment(const MomentExperiment& moment, const std::string& file) {
  const fs::path path(file);
  const fs::path scene = path.parent_path() / (path.stem().string() + ".scene.json");
  Game game;
  game.scene = moment.scene;
  writeFile(scene.string(), toJsonText(movedTo(std::move(game), path.parent_path().string()).scene));
  ExperimentSpec experiment = moment.experiment;
  experiment.scene = scene.filename().string();
  writeFile(file, toJsonText(experiment));
}

}  // namespace btr
