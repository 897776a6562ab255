#include "tests/bench/mujoco_engine.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "core/sim/drive_law.h"
#include "core/sim/trial.h"
#include "tests/rival/mjcf.h"

namespace btr::bench {

struct MujocoEngine::Impl {
  const BenchTask& task;
  mjModel* model = nullptr;
  mjData* data = nullptr;
  std::vector<int> position, velocity;  ///< by joint of the model: addresses, −1 fixed
  int ballBody = -1, ballGeom = -1, floorGeom = -1;

  explicit Impl(const BenchTask& given) : task(given) {
    const std::string xml = rival::mjcf(task.scene);
    mjVFS files;
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "dog.xml", static_cast<int>(xml.size()));
    std::memcpy(files.filedata[files.nfile - 1], xml.data(), xml.size());
    char error[1000] = "";
    model = mj_loadXML("dog.xml", &files, error, sizeof error);
    mj_deleteVFS(&files);
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
    data = mj_makeData(model);
    for (const auto& joint : task.scene.robots[0].model.joints) {
      const int id = joint.type == Joint::Type::fixed ? -1 : mj_name2id(model, mjOBJ_JOINT, joint.name.c_str());
      position.push_back(id < 0 ? -1 : model->jnt_qposadr[id]);
      velocity.push_back(id < 0 ? -1 : model->jnt_dofadr[id]);
    }
    ballBody = mj_name2id(model, mjOBJ_BODY, "ball0");
    ballGeom = mj_name2id(model, mjOBJ_GEOM, "ball0");
    floorGeom = mj_name2id(model, mjOBJ_GEOM, "floor");
  }
  ~Impl() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }

  /// As our own loop decides it: within 5 cm while a servo strains, else within 1 cm.
  bool near(const std::vector<JointInput>& inputs) const {
    if (ballGeom < 0) return false;
    bool strains = false;
    const auto& drives = task.scene.robots[0].drives;
    for (std::size_t j = 0; j < inputs.size(); ++j)
      strains = strains || (position[j] >= 0 &&
                            drives[j].p * std::abs(inputs[j].command - data->qpos[position[j]]) > drives[j].maxTorque);
    const mjtNum* ball = data->geom_xpos + 3 * ballGeom;
    for (int geom = 1; geom < model->ngeom; ++geom) {
      if (geom == ballGeom) continue;
      const mjtNum* at = data->geom_xpos + 3 * geom;
      const double reach = model->geom_rbound[geom] + model->geom_rbound[ballGeom] + (strains ? 0.05 : 0.01);
      const double x = at[0] - ball[0], y = at[1] - ball[1], z = at[2] - ball[2];
      if (x * x + y * y + z * z < reach * reach) return true;
    }
    return false;
  }

  bool touches(int geom) const {
    return std::any_of(data->contact, data->contact + data->ncon, [&](const mjContact& at) {
      return (at.geom1 == ballGeom && at.geom2 == geom) || (at.geom2 == ballGeom && at.geom1 == geom);
    });
  }

  /// As core/sim/trial.cpp ends a trial: the ball rolls freely on the floor, away from the robot, or lies.
  bool ballRollsOut() const {
    if (ballGeom < 0) return true;
    for (int i = 0; i < data->ncon; ++i) {
      const mjContact& at = data->contact[i];
      if ((at.geom1 == ballGeom && at.geom2 != floorGeom) || (at.geom2 == ballGeom && at.geom1 != floorGeom))
        return false;
    }
    const mjtNum* v = data->qvel + model->body_dofadr[ballBody];
    const double speed = std::hypot(v[0], v[1]);
    if (!touches(floorGeom) || std::abs(v[2]) > rolling_free::bounce_m_s) return false;
    if (std::hypot(speed, v[2]) < rolling_free::atRest_m_s) return true;
    const double radius = model->geom_size[3 * ballGeom];
    const mjtNum* p = data->xpos + 3 * ballBody;
    const bool away = v[0] * (p[0] - data->qpos[0]) + v[1] * (p[1] - data->qpos[1]) > 0;
    // A free joint's spin is in the body's frame.
    mjtNum spin[3];
    mju_rotVecQuat(spin, v + 3, data->xquat + 4 * ballBody);
    return away && std::hypot(v[0] - spin[1] * radius, v[1] + spin[0] * radius) <= rolling_free::slipShare * speed;
  }

  void step(const std::vector<JointInput>& inputs, const MujocoWay& way, double h) {
    const auto& drives = task.scene.robots[0].drives;
    model->opt.timestep = h;
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      if (position[j] < 0) continue;
      const Drive& d = drives[j];
      const double pull = d.p * (inputs[j].command - data->qpos[position[j]]);
      const double torque = pull - d.d * data->qvel[velocity[j]];
      // The motor's torque-speed line, as our own drive law has it.
      const double rate = data->qvel[velocity[j]];
      const double high = largestTorque(d, rate), low = -largestTorque(d, -rate);
      const bool within = torque <= high && torque >= low;
      double damping = 0, applied = std::clamp(torque, low, high);
      if (way.implicitServo && within) {
        damping = d.d + h * d.p / 2;
        applied = pull;
      } else if (way.implicitServo && d.noLoadSpeed_rad_s > 0 && torque * rate > 0) {
        damping = d.maxTorque / d.noLoadSpeed_rad_s;
        applied = std::copysign(d.maxTorque, torque);
      }
      model->dof_damping[velocity[j]] = damping;
      data->qfrc_applied[velocity[j]] = applied;
    }
    mj_step(model, data);
  }
};

MujocoEngine::MujocoEngine(const BenchTask& task) : impl_(std::make_unique<Impl>(task)) {}
MujocoEngine::~MujocoEngine() = default;

MujocoOutcome MujocoEngine::run(std::span<const double> parameters, const MujocoWay& way) {
  Impl& e = *impl_;
  const Scene& scene = e.task.scene;
  mj_resetData(e.model, e.data);
  std::fill(e.model->dof_damping, e.model->dof_damping + e.model->nv, 0.0);
  for (std::size_t j = 0; j < e.position.size(); ++j)
    if (e.position[j] >= 0) e.data->qpos[e.position[j]] = scene.robots[0].jointStart[j];
  mj_forward(e.model, e.data);
  const auto motion = e.task.controller->begin(scene, e.task.settings, parameters);
  std::vector<JointInput> inputs(e.position.size());
  const double startX = e.data->qpos[0], startY = e.data->qpos[1];
  double ball[2] = {0, 0};
  if (e.ballBody >= 0) std::copy_n(e.data->xpos + 3 * e.ballBody, 2, ball);

  const long periods = std::lround(motion->duration() / scene.controlPeriod_s);
  const long last = periods + std::lround(TrialOptions{}.settle_s / scene.controlPeriod_s);
  long period = 0;
  for (; period < periods || (period < last && !e.ballRollsOut()); ++period) {
    if (period < periods) motion->command(static_cast<double>(period) * scene.controlPeriod_s, {}, inputs);
    const long steps = std::lround(scene.controlPeriod_s / way.step_s);
    for (long i = 0; i < steps; ++i) {
      const long parts = way.nearStep_s > 0 && e.near(inputs) ? std::lround(way.step_s / way.nearStep_s) : 1;
      for (long part = 0; part < parts; ++part) e.step(inputs, way, way.step_s / static_cast<double>(parts));
    }
  }
  MujocoOutcome outcome;
  outcome.simulated_s = static_cast<double>(period) * scene.controlPeriod_s;
  if (e.data->warning[mjWARN_BADQACC].number + e.data->warning[mjWARN_BADQPOS].number > 0) {
    outcome.way_m = NAN;
  } else if (e.ballBody < 0) {
    outcome.way_m = std::hypot(e.data->qpos[0] - startX, e.data->qpos[1] - startY);
  } else {
    // Position now and the closed form of the roll.
    const mjtNum* p = e.data->xpos + 3 * e.ballBody;
    const mjtNum* v = e.data->qvel + e.model->body_dofadr[e.ballBody];
    const double roll = std::hypot(v[0], v[1]) / (2 * scene.balls[0].rollingDeceleration_m_s2);
    outcome.way_m = std::hypot(p[0] + v[0] * roll - ball[0], p[1] + v[1] * roll - ball[1]);
  }
  return outcome;
}

}  // namespace btr::bench
