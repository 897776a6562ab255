// What a world tells its clients.
#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/model/model_json.h"
#include "core/remote/act_messages.h"
#include "core/remote/world_desk.h"
#include "core/spec/error.h"
#include "uchilsim.pb.h"

namespace btr::remote {
namespace {

namespace v1 = uchilsim::v1;

const char* nameOf(Drive::Kind kind) {
  switch (kind) {
    case Drive::Kind::servo:
      return "servo";
    case Drive::Kind::dcMotor:
      return "dc_motor";
    case Drive::Kind::torque:
      return "torque";
    case Drive::Kind::motion:
      return "motion";
    case Drive::Kind::none:
      break;
  }
  return "none";
}

void describeRobot(const Session& session, const SceneRobot& robot, const PluginHost& host, v1::RobotParts& out) {
  out.set_name(robot.name);
  for (const std::size_t j : movingJoints(robot)) {
    const Joint& joint = robot.model.joints[j];
    v1::JointParts& parts = *out.add_joints();
    parts.set_name(joint.name);
    parts.set_minimum(joint.lower);
    parts.set_maximum(joint.upper);
    parts.set_drive(nameOf(robot.drives[j].kind));
  }
  for (const Link& link : robot.model.links) out.add_links(link.name);
  const auto player = session.game().robots.find(robot.name);
  if (player == session.game().robots.end()) return;
  if (player->second.hasStick()) out.set_controller("openr");
  if (!player->second.hasPlugin()) return;
  const GameController& controller = *player->second.controller;
  out.set_controller(controller.plugin);
  const std::vector<Parameter> genotype = host.controller(controller.plugin)->genotype();
  for (const Parameter& parameter : genotype) {
    v1::NumberParts& parts = *out.add_parameters();
    remote::describe(parameter, parts);
    parts.set_value(valueOf(genotype, controller.parameters, parameter.name));
  }
}

}  // namespace

std::vector<std::size_t> movingJoints(const SceneRobot& robot) {
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
    if (robot.model.joints[j].type != Joint::Type::fixed) moving.push_back(j);
  return moving;
}

void WorldDesk::describe(v1::World& out) {
  const Session& world = session();
  out.set_world(name_);
  out.set_control_period_s(world.scene().controlPeriod_s);
  out.set_episode(episode_);
  out.set_channels_version(channelsVersion_);
  for (const std::string& channel : channels_) out.add_channels(channel);
  for (const SceneRobot& robot : world.scene().robots) describeRobot(world, robot, host_, *out.add_robots());
  for (const BallSpec& ball : world.game().scene.balls) out.add_balls(ball.name);
  for (const ObstacleSpec& obstacle : world.game().scene.obstacles) out.add_obstacles(obstacle.name);
  if (log_) out.set_log(folder_.shown(logFile_));
}

void WorldDesk::fillRow(const v1::Wanted& wanted, v1::State& out) {
  row_.clear();
  session().sample(row_);
  if (wanted.channels().empty()) {
    out.mutable_row()->Add(row_.begin(), row_.end());
    return;
  }
  if (static_cast<std::size_t>(wanted.channels_size()) > channels_.size())
    throw InputError("wanted channels", std::to_string(wanted.channels_size()),
                     "at most " + std::to_string(channels_.size()) + ", those of this world");
  if (!std::ranges::equal(wanted.channels(), chosen_)) {
    std::vector<std::size_t> at;
    for (const std::string& channel : wanted.channels()) {
      const auto found = std::ranges::find(channels_, channel);
      if (found == channels_.end())
        throw InputError("wanted channels", "\"" + channel + "\"", "a channel of this world");
      at.push_back(static_cast<std::size_t>(found - channels_.begin()));
    }
    chosenAt_ = std::move(at);
    chosen_.assign(wanted.channels().begin(), wanted.channels().end());
  }
  for (const std::size_t i : chosenAt_) out.add_row(row_[i]);
}

std::string WorldDesk::state(const v1::Wanted& wanted) {
  Session& world = session();
  v1::State out;
  out.set_world(name_);
  out.set_episode(episode_);
  out.set_period(world.periods());
  out.set_time_s(world.time_s());
  out.set_fault(world.fault());
  out.set_playing(speed_ > 0);
  fillRow(wanted, out);
  out.set_channels_version(channelsVersion_);
  const long known = wanted.has_channels_known() ? static_cast<long>(wanted.channels_known()) : channelsTold_;
  if (known != channelsVersion_)
    for (const std::string& channel : channels_) out.add_channels(channel);
  if (!wanted.has_channels_known()) channelsTold_ = channelsVersion_;
  if (wanted.links())
    for (std::size_t i = 0; i < world.scene().robots.size(); ++i) {
      v1::LinkPoses& poses = *out.add_links();
      for (const Eigen::Isometry3d& pose : world.world().linkPoses(i)) {
        const Eigen::Vector3d p = pose.translation();
        const Eigen::Quaterniond q(pose.linear());
        for (const double number : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) poses.add_pose(number);
      }
    }
  if (wanted.contacts()) {
    if (!world.measuresContacts()) world.measureContacts(true);
    for (const ContactForce& contact : world.world().contactForces()) {
      const auto& [p, f] = contact;
      v1::Contact& each = *out.add_contacts();
      each.set_x_m(p.x());
      each.set_y_m(p.y());
      each.set_z_m(p.z());
      each.set_fx_n(f.x());
      each.set_fy_n(f.y());
      each.set_fz_n(f.z());
    }
  }
  if (const RefereeState* referee = world.referee()) {
    out.mutable_score()->set_red(referee->red);
    out.mutable_score()->set_blue(referee->blue);
    out.mutable_score()->set_half(referee->half);
    out.mutable_score()->set_over(referee->over);
  }
  tellPrograms(wanted, out);
  return out.SerializeAsString();
}

void WorldDesk::tellPrograms(const v1::Wanted& wanted, v1::State& out) const {
  if (programs_)
    for (const auto& [robot, why] : programs_->whyEnded()) {
      v1::Program& program = *out.add_programs();
      program.set_robot(robot);
      program.set_running(why.empty());
      program.set_why(why);
    }
  if (!wanted.has_lines_after()) return;
  long number = lastLine_ - static_cast<long>(said_.size());
  for (const auto& [period, line] : said_) {
    if (++number <= wanted.lines_after()) continue;
    v1::Line& told = *out.add_lines();
    told.set_number(number);
    told.set_period(period);
    told.set_robot(line.robot);
    told.set_object(line.object);
    told.set_text(line.text);
  }
}

std::string WorldDesk::robot(const std::string& name) {
  const Session& world = session();
  const auto& robots = world.scene().robots;
  const auto found = std::ranges::find_if(robots, [&](const SceneRobot& r) { return r.name == name; });
  if (found == robots.end()) throw InputError("robot", "\"" + name + "\"", "a robot of this game");
  v1::RobotReply reply;
  reply.set_model_json(toJson(found->model).dump());
  reply.mutable_start()->Add(found->jointStart.begin(), found->jointStart.end());
  for (const JointInput& input : world.inputs()[static_cast<std::size_t>(found - robots.begin())])
    reply.add_commands(input.command);
  reply.set_seed(world.game().seed);
  if (const auto player = world.game().robots.find(name); player != world.game().robots.end())
    for (const SenseSpec& sense : player->second.senses) reply.add_senses(sense.sense);
  return reply.SerializeAsString();
}

// A camera that fails ends alone: the world goes on, and who asks for a picture is told why.
bool WorldDesk::look(const std::string& robot) {
  Camera& camera = cameras_.at(robot);
  if (!camera.eye) return false;
  try {
    auto picture = camera.eye->look(session());
    if (!picture) return false;
    camera.picture = std::move(*picture);
    camera.period = session().periods();
    ++camera.number;
    if (camera.ring && !camera.ring->fits(camera.picture)) camera.ring.reset();
    if (camera.ring) camera.ring->write(camera.number, camera.period, camera.picture);
    return true;
  } catch (const InputError& error) {
    camera.eye.reset();
    camera.ring.reset();
    camera.why = error.what();
    return false;
  }
}

WorldDesk::Camera& WorldDesk::camera(const std::string& name) {
  if (!makeCamera_) throw Refusal(Code::notThere, "this server has no cameras; btr live --camera renders them");
  const auto& robots = session().scene().robots;
  if (std::ranges::none_of(robots, [&](const SceneRobot& r) { return r.name == name; }))
    throw InputError("robot", "\"" + name + "\"", "a robot of this game");
  if (!cameras_.contains(name) && cameras_.size() >= mostCameras) {
    // Those of robots that went.
    std::erase_if(cameras_, [&](const auto& each) {
      return std::ranges::none_of(robots, [&](const SceneRobot& r) { return r.name == each.first; });
    });
    if (cameras_.size() >= mostCameras)
      throw Refusal(Code::tooMuch, "more than " + std::to_string(mostCameras) + " cameras of a world");
  }
  Camera& camera = cameras_[name];
  if (!camera.eye && camera.why.empty()) {
    camera.eye = makeCamera_(name);
    look(name);
  }
  if (!camera.eye) throw Refusal(Code::notNow, std::exchange(camera.why, ""));  // the next call tries again
  return camera;
}

std::string WorldDesk::picture(const v1::PictureRequest& request) {
  const Camera& camera = this->camera(request.robot());
  v1::PictureReply reply;
  if (camera.number > request.after() && !camera.picture.rgb.empty()) {
    reply.set_number(camera.number);
    reply.set_period(camera.period);
    reply.set_width(camera.picture.width);
    reply.set_height(camera.picture.height);
    reply.set_rgb(camera.picture.rgb.data(), camera.picture.rgb.size());
    reply.set_classes(camera.picture.classes.data(), camera.picture.classes.size());
  }
  return reply.SerializeAsString();
}

std::string WorldDesk::pictureMemory(const v1::PictureMemoryRequest& request) {
  Camera& camera = this->camera(request.robot());
  v1::PictureMemoryReply reply;
  if (camera.number > 0 && !camera.picture.rgb.empty()) {
    if (!camera.ring) {
      camera.ring = std::make_unique<PictureRing>(camera.picture);
      camera.ring->write(camera.number, camera.period, camera.picture);
    }
    reply.set_file(camera.ring->file());
    reply.set_bytes(static_cast<std::int64_t>(camera.ring->bytes()));
    reply.set_mark(camera.ring->mark());
    reply.set_layout(1);
  }
  return reply.SerializeAsString();
}

}  // namespace btr::remote
