#include "tests/rival/mujoco_world.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/sim/drive_law.h"

namespace btr::rival {
namespace {

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

struct RivalJoint {
  int position = -1, velocity = -1;  ///< addresses, −1 fixed
  JointEffects effects;
  double integral = 0, torque = 0, command = 0;
};

struct RivalBall {
  int body = -1, geom = -1, velocity = -1;
  double radius = 0, mass = 0;
};

std::unique_ptr<mjModel, ModelDeleter> compile(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[files->nfile - 1], xml.data(), xml.size());
  std::array<char, 1000> error{};
  std::unique_ptr<mjModel, ModelDeleter> model(
      mj_loadXML("scene.xml", files.get(), error.data(), static_cast<int>(error.size())));
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error.data());
  return model;
}

}  // namespace

struct MujocoWorld::Impl {
  Scene scene;
  const SceneRobot* robot = nullptr;
  std::unique_ptr<mjModel, ModelDeleter> model;
  std::unique_ptr<mjData, DataDeleter> data;
  std::vector<RivalJoint> joints;
  std::vector<RivalBall> balls;
  int floor = -1;

  Impl(const Scene& given, const MjcfOptions& options) : scene(given) {
    model = compile(mjcf(scene, options));
    data.reset(mj_makeData(model.get()));
    floor = mj_name2id(model.get(), mjOBJ_GEOM, "floor");
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
      const std::string name = "ball" + std::to_string(i);
      RivalBall ball{mj_name2id(model.get(), mjOBJ_BODY, name.c_str()),
                     mj_name2id(model.get(), mjOBJ_GEOM, name.c_str()), -1, scene.balls[i].radius_m,
                     scene.balls[i].mass_kg};
      ball.velocity = model->body_dofadr[ball.body];
      balls.push_back(ball);
    }
    if (scene.robots.empty()) return;
    robot = &scene.robots[0];
    for (const Joint& joint : robot->model.joints) {
      joints.emplace_back();
      if (joint.type == Joint::Type::fixed) continue;
      const int id = mj_name2id(model.get(), mjOBJ_JOINT, joint.name.c_str());
      joints.back().position = model->jnt_qposadr[id];
      joints.back().velocity = model->jnt_dofadr[id];
      for (const SceneEffect& effect : scene.effects)
        if (effect.at == robot->name + "." + joint.name) joints.back().effects.add(effect);
    }
  }

  JointState stateOf(std::size_t j) const {
    const RivalJoint& joint = joints[j];
    return {data->time, data->qpos[joint.position], data->qvel[joint.velocity], joint.command, joint.torque, true};
  }

  /// Drive and effects as applied torques; dry friction as the engine's own friction loss, viscous as its damping.
  void drive(std::size_t j, const JointInput& input, double h) {
    RivalJoint& joint = joints[j];
    const Drive& spec = robot->drives[j];
    joint.command = input.command;
    JointState state = stateOf(j);
    if (!joint.effects.empty()) state.command = joint.effects.command({input.command, input.command}, state, h).mean();
    if (spec.i > 0) joint.integral = input.enabled ? joint.integral + (state.command - state.position) * h : 0;
    const double inertia = 1e9;  // the laws' own corrections for large steps are not wanted here
    const StepOf step{h, inertia};
    DriveRow row;
    row.p = driveTorque(spec, state, joint.integral, input);
    DriveRow passive;
    double dry = spec.coulombFriction;
    if (!joint.effects.empty()) {
      row = joint.effects.drive(row, spec, state, {state.command, state.command}, joint.integral, input, step);
      joint.effects.addPassive(passive, state, step);
      dry += joint.effects.dryFriction(state).limit;
    }
    joint.torque = row.torqueAt(state.rate);
    // The servo's own damping is implicit where nothing limits or changes it: light links need that.
    const bool plain = joint.effects.empty() && spec.kind == Drive::Kind::servo && input.enabled &&
                       joint.torque < largestTorque(spec, state.rate) &&
                       joint.torque > -largestTorque(spec, -state.rate);
    const double damping = plain ? spec.d : 0;
    data->qfrc_applied[joint.velocity] = joint.torque + damping * state.rate + passive.p - passive.d * state.rate;
    model->dof_frictionloss[joint.velocity] = std::max(1e-9, dry);
    model->dof_damping[joint.velocity] = spec.viscousFriction + damping;
  }
};

MujocoWorld::MujocoWorld(const Scene& scene, const MjcfOptions& options)
    : impl_(std::make_unique<Impl>(scene, options)) {}
MujocoWorld::~MujocoWorld() = default;

void MujocoWorld::start(std::span<const double> positions) {
  mj_resetData(impl_->model.get(), impl_->data.get());
  for (std::size_t j = 0; j < impl_->joints.size(); ++j)
    if (impl_->joints[j].position >= 0) impl_->data->qpos[impl_->joints[j].position] = positions[j];
  mj_forward(impl_->model.get(), impl_->data.get());
}

void MujocoWorld::advance(const std::vector<JointInput>& inputs, double duration) {
  const long count = std::max(1L, std::lround(duration / impl_->scene.step_s));
  impl_->model->opt.timestep = duration / static_cast<double>(count);
  for (long i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < impl_->joints.size(); ++j)
      if (impl_->joints[j].position >= 0) impl_->drive(j, inputs[j], impl_->model->opt.timestep);
    mj_step(impl_->model.get(), impl_->data.get());
  }
}

double MujocoWorld::time() const { return impl_->data->time; }

bool MujocoWorld::failed() const {
  const auto& warning = impl_->data->warning;
  return warning[mjWARN_BADQACC].number + warning[mjWARN_BADQPOS].number + warning[mjWARN_BADQVEL].number > 0;
}

Eigen::Isometry3d MujocoWorld::base() const {
  if (!impl_->robot->freeBase) return impl_->robot->start;
  const double* q = impl_->data->qpos;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << q[0], q[1], q[2];
  pose.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).normalized().toRotationMatrix();
  return pose;
}

double MujocoWorld::position(std::size_t joint) const {
  const int at = impl_->joints[joint].position;
  return at < 0 ? 0 : impl_->data->qpos[at];
}

double MujocoWorld::rate(std::size_t joint) const {
  const int at = impl_->joints[joint].velocity;
  return at < 0 ? 0 : impl_->data->qvel[at];
}

double MujocoWorld::measured(std::size_t index, double dt) {
  RivalJoint& joint = impl_->joints[index];
  const double truth = position(index);
  return joint.position < 0 || joint.effects.empty() ? truth : joint.effects.measured(truth, impl_->stateOf(index), dt);
}

BallState MujocoWorld::ball(std::size_t index) const {
  const RivalBall& ball = impl_->balls[index];
  const mjtNum* p = impl_->data->xpos + 3 * ball.body;
  const mjtNum* v = impl_->data->qvel + ball.velocity;
  // Their angular velocity is in the body's own axes.
  const mjtNum* q = impl_->data->xquat + 4 * ball.body;
  BallState state;
  state.time = time();
  state.position_m << p[0], p[1], p[2];
  state.velocity_m_s << v[0], v[1], v[2];
  state.spin_rad_s = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Eigen::Vector3d(v[3], v[4], v[5]);
  state.radius_m = ball.radius;
  state.mass_kg = ball.mass;
  state.onFloor = impl_->floor >= 0 && state.position_m.z() < ball.radius + 1e-3;
  return state;
}

bool MujocoWorld::ballTouched(std::size_t index) const {
  const int geom = impl_->balls[index].geom;
  for (int i = 0; i < impl_->data->ncon; ++i) {
    const mjContact& contact = impl_->data->contact[i];
    const int other = contact.geom1 == geom ? contact.geom2 : contact.geom2 == geom ? contact.geom1 : -1;
    if (other >= 0 && other != impl_->floor && contact.efc_address >= 0) return true;
  }
  return false;
}

}  // namespace btr::rival
