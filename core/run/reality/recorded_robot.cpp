#include "core/run/reality/recorded_robot.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

/// Where a robot's body is.
bool isOfBody(const std::string& channel) {
  const auto name = parseChannel(channel);
  return name && name->part == "base";
}

/// Analysed after it was hung up: what that said of its joints stays.
bool afterHanging(const RecordingsSpec& spec, RobotPose pose) {
  return pose == RobotPose::onFloor && spec.poses().size() > 1;
}

/// What the analysis may fit, "path in [minimum, maximum]".
std::vector<CalibratePath> numbersToFit(const RecordingsSpec& spec, const SimulatorSpec& simulator, RobotPose pose) {
  const bool later = afterHanging(spec, pose);
  const std::vector<std::string> servos{"servo_p_nm_rad", "servo_d_nm_s_rad", "servo_max_torque_nm"},
      floor{"friction", "slip1_m_s_n", "slip2_m_s_n"};
  const std::vector<std::string>& named = later ? spec.calibrateOnFloor : spec.calibrate;
  const double within = valueOf(recordingParameters(), spec.settings, "calibrate_within");
  std::vector<CalibratePath> paths;
  for (const std::string& name : !named.empty() ? named : later ? floor : servos) {
    const Parameter& p = *find(simulatorParameters(), name);
    const double value = valueOf(simulatorParameters(), simulator.values, name), most = within * std::abs(value);
    // Nobody has an idea of a floor beforehand.
    const bool anywhere = later || most <= 0;
    paths.push_back({name, anywhere ? p.minimum : std::max(p.minimum, value - most),
                     anywhere ? p.maximum : std::min(p.maximum, value + most)});
  }
  return paths;
}

void drop(Recording& recording, std::size_t channel) {
  recording.channels.erase(recording.channels.begin() + static_cast<std::ptrdiff_t>(channel));
  recording.columns.erase(recording.columns.begin() + static_cast<std::ptrdiff_t>(channel));
}

/// Of a model: the joints of those branches of the body that carry one of the named joints ("ers7.LF_J3"). They alone
/// move what is compared while the body is held.
std::vector<char> movesWhatIsCompared(const RobotModel& model, const std::string& robot,
                                      const std::vector<std::string>& joints) {
  std::vector<std::size_t> branch(model.joints.size());  // the joint at the body that each hangs from
  for (std::size_t j = 0; j < branch.size(); ++j) {
    const auto parent = static_cast<std::size_t>(model.joints[j].parentLink);
    branch[j] = parent == 0 ? j : branch[parent - 1];
  }
  std::vector<char> moves(model.joints.size(), joints.empty());
  for (std::size_t j = 0; j < branch.size(); ++j)
    if (std::ranges::count(joints, robot + "." + model.joints[j].name) > 0)
      for (std::size_t k = 0; k < branch.size(); ++k) moves[k] |= branch[k] == branch[j];
  return moves;
}

/// A hung robot's branches do not feel each other: those that nobody compares become part of the body, which saves most
/// of the time and all places where an effect could not be seen.
void leaveOutUnseenBranches(GapProblem& problem, const std::vector<std::string>& joints) {
  RobotSpec& robot = problem.scene.robots.front();
  RobotModel model = *problem.models.at(robot.model);
  const std::vector<char> moves = movesWhatIsCompared(model, robot.name, joints);
  for (std::size_t j = 0; j < moves.size(); ++j) {
    const std::string name = model.joints[j].name, channel = robot.name + "." + name;
    // An effect that sits there already needs its joint.
    const bool hasEffect = std::ranges::any_of(problem.simulator.effects,
                                               [&](const PlacedEffect& effect) { return effect.at == channel; });
    if (moves[j] || hasEffect) continue;
    model.joints[j].type = Joint::Type::fixed;
    robot.jointStart.erase(name);
    robot.jointRate.erase(name);
    robot.servos.erase(name);
    robot.joints.erase(name);
    for (Recording& recording : problem.recordings)
      for (std::size_t c = recording.channels.size(); c-- > 1;)
        if (recording.channels[c].starts_with(channel + ".")) drop(recording, c);
  }
  robot.model += " (what is compared)";
  problem.models[robot.model] = std::make_shared<const RobotModel>(std::move(model));
}

}  // namespace

Scene recordedScene(const PreparedExperiment& prepared, const SimulatorSpec& simulator, RobotPose pose) {
  constexpr double higher_m = 1;
  Scene scene = prepared.scene(simulator);
  if (pose == RobotPose::hungUp) {
    SceneRobot& robot = scene.robots.front();
    robot.freeBase = false;
    robot.startVelocity_m_s.setZero();
    robot.startSpin_rad_s.setZero();
    robot.start.translation().z() += higher_m;
  }
  return scene;
}

GapProblem recordedProblem(const PreparedExperiment& prepared, const SimulatorSpec& simulator,
                           std::vector<Recording> recordings, RobotPose pose) {
  const RecordingsSpec& spec = prepared.spec.recordings;
  GapProblem problem;
  problem.scene = prepared.sceneSpec;
  problem.models = prepared.models;
  problem.simulator = simulator;
  problem.recordings = std::move(recordings);

  // Where the controller has put robot and ball.
  const Scene arranged = recordedScene(prepared, simulator, pose);
  RobotSpec& robot = problem.scene.robots.front();
  const SceneRobot& placed = arranged.robots.front();
  const Eigen::Quaterniond turned(placed.start.linear());
  Eigen::Vector3d::Map(robot.position_m.data()) = placed.start.translation();
  robot.orientation_wxyz = {turned.w(), turned.x(), turned.y(), turned.z()};
  for (std::size_t b = 0; b < arranged.balls.size(); ++b)
    problem.scene.balls[b].position_m = arranged.balls[b].position_m;
  // In the air nothing is touched.
  if (pose == RobotPose::hungUp) {
    robot.base = "fixed";
    robot.velocity_m_s = robot.spin_rad_s = {0, 0, 0};
    robot.collision = "none";
  }

  problem.scene.calibrate = numbersToFit(spec, simulator, pose);

  const bool placesAlone = valueOf(recordingParameters(), spec.settings, "floor_compares") == 1;
  const auto isCompared = [&](const std::string& channel) {
    if (!channel.ends_with(".position_rad")) return true;
    if (afterHanging(spec, pose)) return !placesAlone;
    if (spec.joints.empty()) return true;
    return std::ranges::any_of(spec.joints,
                               [&](const std::string& joint) { return channel == joint + ".position_rad"; });
  };
  // What is not compared still says where its joint began.
  for (Recording& recording : problem.recordings)
    for (const std::string& channel : recording.channels)
      if (!isCompared(channel)) recording.notCompared.push_back(channel);
  // A trial begins with a robot that stands; what the floor does to its joints next is not taken for a start in motion.
  if (pose == RobotPose::onFloor)
    for (Recording& recording : problem.recordings) recording.beginsAtRest = true;
  problem.firstSteps_s = valueOf(recordingParameters(), spec.settings, "floor_compared_s");
  if (pose == RobotPose::hungUp) leaveOutUnseenBranches(problem, spec.joints);
  return problem;
}

std::vector<std::string> consideredEffects(const PreparedExperiment& prepared, const PluginHost& host, RobotPose pose) {
  const RecordingsSpec& spec = prepared.spec.recordings;
  const bool later = afterHanging(spec, pose);
  const std::vector<std::string>& named = later ? spec.effectsOnFloor : spec.effects;
  if (!named.empty()) return named;
  std::vector<std::string> names = host.effects();
  const auto actsOnJoints = [&](const std::string& name) { return host.effect(name)->place() == Effect::Place::joint; };
  if (pose == RobotPose::hungUp) std::erase_if(names, std::not_fn(actsOnJoints));
  if (later) std::erase_if(names, actsOnJoints);
  return names;
}

RobotPose poseOf(const Recording& recording) {
  return std::ranges::any_of(recording.channels, isOfBody) ? RobotPose::onFloor : RobotPose::hungUp;
}

void writeRecording(const Trace& trace, const std::string& path, RobotPose pose, Random& random) {
  std::string text;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < trace.channels.size(); ++c) {
    const std::string& name = trace.channels[c];
    const bool isSeen = name.starts_with("ball") || (pose == RobotPose::onFloor && isOfBody(name));
    const bool wanted = name == "time_s" || name.ends_with(".command_rad") || name.ends_with(".position_rad") ||
                        (isSeen && (name.ends_with(".x_m") || name.ends_with(".y_m")));
    if (!wanted) continue;
    text += (kept.empty() ? "" : ",") + name;
    kept.push_back(c);
  }
  text += '\n';
  for (std::size_t row = 0; row < trace.rows(); ++row) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const std::string& name = trace.channels[kept[i]];
      // A trace has the command that led to its row; in a recording a command holds from its row on.
      const bool leads = name.ends_with(".command_rad") && row + 1 < trace.rows();
      double value = trace.at(leads ? row + 1 : row, kept[i]);
      // A potentiometer's and a camera's noise and resolution.
      if (name.ends_with(".position_rad")) value = std::round((value + 0.001 * random.normal()) * 1000) / 1000;
      if (name.ends_with("_m")) value = std::round((value + 0.002 * random.normal()) * 1000) / 1000;
      text += (i ? "," : "") + toText(value);
    }
    text += '\n';
  }
  writeFile(path, text);
}

}  // namespace btr
