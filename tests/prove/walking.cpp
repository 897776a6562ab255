// An ERS-7 that trots over the floor, seen by a camera from above and by its own joints.
#include <cmath>

#include "core/model/load_model.h"
#include "core/sim/trot.h"
#include "core/spec/json_reader.h"
#include "tests/prove/blind_world.h"

namespace btr::prove {
namespace {

constexpr const char* file = "ers7.wrl";

Scene plainScene(const BlindWorld& world) { return makeScene(world.scene, world.models, {}, {}); }

void setStart(RobotSpec& robot, const SceneRobot& arranged) {
  for (std::size_t j = 0; j < arranged.model.joints.size(); ++j)
    if (arranged.model.joints[j].type != Joint::Type::fixed)
      robot.jointStart[arranged.model.joints[j].name] = arranged.jointStart[j];
  robot.position_m[2] = arranged.start.translation().z();
}

}  // namespace

BlindWorld drawWalk(Random& random) {
  BlindWorld world;
  world.files[file] = readFile(SOURCE_DIR "/resources/robots/ers7.wrl");
  world.models[file] = std::make_shared<const RobotModel>(parseVrml(world.files[file], file));
  RobotSpec robot;
  robot.name = "dog";
  robot.model = file;
  world.scene.robots.push_back(robot);
  world.scene.controlPeriod_s = 0.008;
  world.scene.step_s = 0.002;  // at 4 and 8 ms feet land so differently that no replay holds for seconds
  world.scene.floor.emplace();
  world.scene.floor->friction = random.uniform(0.7, 1.3);
  world.fineStep_s = 1e-3;

  const Trot trot;
  Scene arranged = plainScene(world);
  trot.arrange(arranged, {});
  setStart(world.scene.robots[0], arranged.robots[0]);
  const auto& joints = world.models[file]->joints;

  calibrate(world, random, "floor.friction", world.scene.floor->friction);
  // Gains of the knees or of the hips: who calibrates a dog's gait rarely frees all twelve.
  const std::string which = random.chance(0.5) ? "_J1" : "_J3";
  for (const char* leg : {"LF", "LR", "RF", "RR"}) {
    const int joint = world.models[file]->findJoint(leg + which);
    const double p = arranged.robots[0].drives.at(static_cast<std::size_t>(joint)).p;
    world.scene.robots[0].servos[leg + which].numbers["p"] = p;
    calibrate(world, random, "robots.dog.servos." + (leg + which) + ".p", p);
  }

  const Sensor encoder = drawSensor(random, 4e-3, 1e-2, 0.5, 1);
  const double baseNoise = drawLog(random, 3e-3, 8e-3);
  const double attitudeNoise = drawLog(random, 8e-3, 2e-2);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::string& name = joints[j].name;
    if (name.size() != 5 || name.compare(2, 2, "_J") != 0) continue;
    world.commanded.push_back(j);
    addColumn(world, MeasuredColumn::What::position, j, "dog." + name + ".position_rad", encoder);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    addColumn(world, MeasuredColumn::What::basePosition, axis, std::string("dog.base.") + "xyz"[axis] + "_m",
              {baseNoise, 0});
  for (std::size_t part = 0; part < 4; ++part)
    addColumn(world, MeasuredColumn::What::baseOrientation, part, std::string("dog.base.q") + "wxyz" [part],
              { attitudeNoise, 0 });

  constexpr int shown = 3, keptBack = 1;
  for (int i = 0; i < shown + keptBack; ++i) {
    const Values settings{{"cycle_s", random.uniform(0.4, 0.6)},
                          {"stride_m", random.uniform(0.02, 0.05)},
                          {"lift_m", random.uniform(0.015, 0.03)},
                          {"duration_s", 100}};
    const auto motion = trot.begin(arranged, settings, {});
    TrialPlan trial;
    trial.sample_s = 0.008;
    trial.settle_s = 1;
    const double still_s = 0.2;
    trial.rows = static_cast<std::size_t>(std::lround(4 / trial.sample_s)) + 1;
    trial.jointStart = arranged.robots[0].jointStart;
    std::vector<JointInput> inputs(joints.size());
    for (std::size_t row = 0; row < trial.rows; ++row) {
      const double t = std::max(0.0, trial.sample_s * static_cast<double>(row) - still_s);
      motion->command(t, {}, inputs);
      trial.commands.push_back(trial.jointStart);
      for (const std::size_t j : world.commanded) trial.commands.back()[j] = inputs[j].command;
    }
    world.trials.push_back(std::move(trial));
  }
  keepBack(world, keptBack);
  return world;
}

}  // namespace btr::prove
