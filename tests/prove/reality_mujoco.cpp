#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "core/sim/drive_law.h"
#include "core/spec/error.h"
#include "tests/prove/reality.h"

namespace btr::prove {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

std::string text(const Vector3d& v) { return toText(v.x()) + " " + toText(v.y()) + " " + toText(v.z()); }
std::string pose(const Isometry3d& p) {
  const Eigen::Quaterniond q(p.linear());
  return "pos=\"" + text(p.translation()) + "\" quat=\"" + toText(q.w()) + " " + toText(q.x()) + " " + toText(q.y()) +
         " " + toText(q.z()) + "\"";
}

void writeShapes(std::ostream& out, const Link& link) {
  for (const auto& shape : link.shapes) {
    if (!shape.collides || shape.kind == Shape::Kind::mesh) continue;
    Isometry3d at = shape.pose;
    out << "<geom contype=\"1\" conaffinity=\"0\" ";
    if (shape.kind == Shape::Kind::sphere) out << "type=\"sphere\" size=\"" << toText(shape.size_m.x()) << "\" ";
    if (shape.kind == Shape::Kind::box) out << "type=\"box\" size=\"" << text(shape.size_m / 2) << "\" ";
    if (shape.kind == Shape::Kind::cylinder) {
      at.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));  // theirs lie along z, ours along y
      out << "type=\"cylinder\" size=\"" << toText(shape.size_m.x()) << " " << toText(shape.size_m.y() / 2) << "\" ";
    }
    out << pose(at) << "/>";
  }
}

/// `h` is the step: dry friction that is as stiff as it allows, else a joint at rest creeps.
void writeLink(std::ostream& out, const SceneRobot& robot, std::size_t index, const Isometry3d& place, double h) {
  const RobotModel& model = robot.model;
  const Link& link = model.links[index];
  out << "<body name=\"" << link.name << "\" " << pose(place) << ">";
  if (index == 0 && robot.freeBase) out << "<freejoint name=\"base\"/>";
  if (index > 0 && model.joints[index - 1].type != Joint::Type::fixed) {
    const Joint& joint = model.joints[index - 1];
    const bool limited = joint.upper < 1e6;
    out << "<joint name=\"" << joint.name << "\" axis=\"" << text(joint.axis) << "\" armature=\""
        << toText(robot.drives[index - 1].rotorInertia_kg_m2)
        << "\" frictionloss=\"1e-9\" solimpfriction=\"0.999 0.999 0.001\" solreffriction=\"" << toText(2 * h)
        << " 1\" limited=\"" << (limited ? "true" : "false") << "\"";
    if (limited) out << " range=\"" << toText(joint.lower - 0.0873) << " " << toText(joint.upper + 0.0873) << "\"";
    out << "/>";
  }
  const auto& inertia = link.inertial.inertia_kg_m2;
  out << "<inertial pos=\"" << text(link.inertial.centreOfMass_m) << "\" mass=\"" << toText(link.inertial.mass_kg)
      << "\" fullinertia=\"" << toText(inertia(0, 0)) << " " << toText(inertia(1, 1)) << " " << toText(inertia(2, 2))
      << " " << toText(inertia(0, 1)) << " " << toText(inertia(0, 2)) << " " << toText(inertia(1, 2)) << "\"/>";
  if (robot.collision != "none") writeShapes(out, link);
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (model.joints[j].parentLink == static_cast<int>(index)) writeLink(out, robot, j + 1, model.joints[j].origin, h);
  out << "</body>";
}

std::string modelText(const Scene& scene) {
  std::ostringstream out;
  const double friction = scene.floor ? scene.floor->friction : 1;
  out << "<mujoco><compiler angle=\"radian\" balanceinertia=\"false\"/><option gravity=\"" << text(scene.gravity_m_s2)
      << "\" cone=\"elliptic\" impratio=\"10\" integrator=\"implicit\" timestep=\"" << toText(scene.step_s)
      << "\"/><default><geom solref=\"0.005 1\" friction=\"" << toText(friction) << " 0 0\"/></default><worldbody>";
  if (scene.floor) out << "<geom type=\"plane\" size=\"50 50 1\" contype=\"0\" conaffinity=\"3\"/>";
  writeLink(out, scene.robots[0], 0, scene.robots[0].start, scene.step_s);
  out << "</worldbody></mujoco>";
  return out.str();
}

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

class Rival {
 public:
  explicit Rival(const Scene& scene) : scene_(scene), robot_(scene_.robots.at(0)) {
    const std::string xml = modelText(scene_);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(xml.size()));
    std::memcpy(files->filedata[files->nfile - 1], xml.data(), xml.size());
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML("robot.xml", files.get(), error.data(), static_cast<int>(error.size())));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(std::string("MuJoCo: ") + error.data());
    data_.reset(mj_makeData(model_.get()));
    for (std::size_t j = 0; j < robot_.model.joints.size(); ++j) {
      const Joint& joint = robot_.model.joints[j];
      joints_.emplace_back();
      if (joint.type == Joint::Type::fixed) continue;
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint.name.c_str());
      joints_[j].position = model_->jnt_qposadr[id];
      joints_[j].velocity = model_->jnt_dofadr[id];
      for (const SceneEffect& effect : scene_.effects)
        if (effect.at == robot_.name + "." + joint.name) joints_[j].effects.add(effect);
    }
  }

  void start(const std::vector<double>& positions) {
    mj_resetData(model_.get(), data_.get());
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j].position >= 0) data_->qpos[joints_[j].position] = positions[j];
    mj_forward(model_.get(), data_.get());
  }

  void advance(const std::vector<JointInput>& inputs, double duration) {
    const long count = std::max(1L, std::lround(duration / scene_.step_s));
    model_->opt.timestep = duration / static_cast<double>(count);
    for (long i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < joints_.size(); ++j)
        if (joints_[j].position >= 0) drive(j, inputs[j], model_->opt.timestep);
      mj_step(model_.get(), data_.get());
    }
  }

  bool failed() const {
    return data_->warning[mjWARN_BADQACC].number + data_->warning[mjWARN_BADQPOS].number +
               data_->warning[mjWARN_BADQVEL].number >
           0;
  }

  double read(const MeasuredColumn& column, double dt) {
    const double* q = data_->qpos + 3;
    switch (column.what) {
      case MeasuredColumn::What::position: {
        RivalJoint& joint = joints_[column.part];
        const double position = data_->qpos[joint.position];
        return joint.effects.empty() ? position : joint.effects.measured(position, stateOf(column.part), dt);
      }
      case MeasuredColumn::What::rate:
        return data_->qvel[joints_[column.part].velocity];
      case MeasuredColumn::What::basePosition:
        return data_->qpos[column.part];
      case MeasuredColumn::What::baseOrientation:
        return (q[0] < 0 ? -1 : 1) * q[column.part];
      case MeasuredColumn::What::ballPosition:
        break;
    }
    throw InputError("--engine mujoco: balls are not part of it");
  }

 private:
  struct RivalJoint {
    int position = -1, velocity = -1;  ///< addresses, −1 fixed
    JointEffects effects;
    double integral = 0, torque = 0, command = 0;
  };

  JointState stateOf(std::size_t j) const {
    const RivalJoint& joint = joints_[j];
    return {data_->time, data_->qpos[joint.position], data_->qvel[joint.velocity], joint.command, joint.torque, true};
  }

  /// Drive and effects as applied torques; dry friction as the engine's own friction loss, viscous as its damping.
  void drive(std::size_t j, const JointInput& input, double h) {
    RivalJoint& joint = joints_[j];
    const Drive& spec = robot_.drives[j];
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
      dry += joint.effects.frictionLimit(state);
    }
    joint.torque = row.torqueAt(state.rate);
    // The servo's own damping is implicit where nothing limits or changes it: light links need that.
    const bool plain = joint.effects.empty() && spec.kind == Drive::Kind::servo && input.enabled &&
                       std::abs(joint.torque) < spec.maxTorque;
    const double damping = plain ? spec.d : 0;
    data_->qfrc_applied[joint.velocity] = joint.torque + damping * state.rate + passive.p - passive.d * state.rate;
    model_->dof_frictionloss[joint.velocity] = std::max(1e-9, dry);
    model_->dof_damping[joint.velocity] = spec.viscousFriction + damping;
  }

  Scene scene_;
  const SceneRobot& robot_;
  std::unique_ptr<mjModel, ModelDeleter> model_;
  std::unique_ptr<mjData, DataDeleter> data_;
  std::vector<RivalJoint> joints_;
};

}  // namespace

bool hasMujoco() { return true; }

Truth simulateMujoco(const Scene& scene, const TrialPlan& plan, const std::vector<MeasuredColumn>& columns) {
  Truth truth;
  truth.values.assign(columns.size(), std::vector<double>(plan.rows, 0.0));
  Rival rival(scene);
  rival.start(plan.jointStart);
  if (plan.settle_s > 0) rival.advance(inputsOf(plan, 0), plan.settle_s);
  for (std::size_t row = 0; row < plan.rows; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      truth.values[i][row] = rival.read(columns[i], row == 0 ? 0 : plan.sample_s);
    if (row + 1 == plan.rows) break;
    rival.advance(inputsOf(plan, row), plan.sample_s);
    if (rival.failed()) {
      truth.fault = "MuJoCo: a bad acceleration, speed or position";
      break;
    }
  }
  return truth;
}

}  // namespace btr::prove
