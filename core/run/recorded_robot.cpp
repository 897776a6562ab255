#include "core/run/recorded_robot.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/spec/json_reader.h"

namespace btr {
namespace {

bool isHung(const PreparedExperiment& prepared) {
  return valueOf(recordingParameters(), prepared.spec.recordings.settings, "robot") == 0;
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

Scene recordedScene(const PreparedExperiment& prepared, const SimulatorSpec& simulator) {
  constexpr double higher_m = 1;
  Scene scene = prepared.scene(simulator);
  if (isHung(prepared)) {
    SceneRobot& robot = scene.robots.front();
    robot.freeBase = false;
    robot.start.translation().z() += higher_m;
  }
  return scene;
}

GapProblem recordedProblem(const PreparedExperiment& prepared, const SimulatorSpec& simulator,
                           std::vector<Recording> recordings) {
  const RecordingsSpec& spec = prepared.spec.recordings;
  GapProblem problem;
  problem.scene = prepared.sceneSpec;
  problem.models = prepared.models;
  problem.simulator = simulator;
  problem.recordings = std::move(recordings);

  // Where the controller has put robot and ball.
  const Scene arranged = recordedScene(prepared, simulator);
  RobotSpec& robot = problem.scene.robots.front();
  const SceneRobot& placed = arranged.robots.front();
  const Eigen::Quaterniond turned(placed.start.linear());
  Eigen::Vector3d::Map(robot.position_m.data()) = placed.start.translation();
  robot.orientation_wxyz = {turned.w(), turned.x(), turned.y(), turned.z()};
  for (std::size_t b = 0; b < arranged.balls.size(); ++b)
    problem.scene.balls[b].position_m = arranged.balls[b].position_m;
  // In the air nothing is touched.
  if (isHung(prepared)) {
    robot.base = "fixed";
    robot.collision = "none";
  }

  const std::vector<std::string> servos{"servo_p_nm_rad", "servo_d_nm_s_rad", "servo_max_torque_nm"};
  const double within = valueOf(recordingParameters(), spec.settings, "calibrate_within");
  problem.scene.calibrate.clear();
  for (const std::string& name : spec.calibrate.empty() ? servos : spec.calibrate) {
    const Parameter& p = *find(simulatorParameters(), name);
    const double value = valueOf(simulatorParameters(), simulator.values, name), most = within * std::abs(value);
    problem.scene.calibrate.push_back({name, most > 0 ? std::max(p.minimum, value - most) : p.minimum,
                                       most > 0 ? std::min(p.maximum, value + most) : p.maximum});
  }

  const auto isCompared = [&](const std::string& channel) {
    if (spec.joints.empty() || !channel.ends_with(".position_rad")) return true;
    return std::ranges::any_of(spec.joints,
                               [&](const std::string& joint) { return channel == joint + ".position_rad"; });
  };
  // What is not compared still says where its joint began.
  for (Recording& recording : problem.recordings)
    for (const std::string& channel : recording.channels)
      if (!isCompared(channel)) recording.notCompared.push_back(channel);
  if (isHung(prepared)) leaveOutUnseenBranches(problem, spec.joints);
  return problem;
}

std::vector<std::string> consideredEffects(const PreparedExperiment& prepared, const PluginHost& host) {
  const std::vector<std::string>& named = prepared.spec.recordings.effects;
  if (!named.empty()) return named;
  std::vector<std::string> names = host.effects();
  if (isHung(prepared))
    std::erase_if(names, [&](const std::string& name) { return host.effect(name)->place() != Effect::Place::joint; });
  return names;
}

void writeRecording(const Trace& trace, const std::string& path, Random& random) {
  std::string text;
  std::vector<std::size_t> kept;
  for (std::size_t c = 0; c < trace.channels.size(); ++c) {
    const std::string& name = trace.channels[c];
    const bool wanted = name == "time_s" || name.ends_with(".command_rad") || name.ends_with(".position_rad") ||
                        (name.starts_with("ball") && (name.ends_with(".x_m") || name.ends_with(".y_m")));
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
