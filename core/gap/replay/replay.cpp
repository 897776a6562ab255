#include "core/gap/replay/replay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gap/recordings/between_rows.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/followed_torques.h"
#include "core/gap/replay/hanging.h"
#include "core/gap/replay/start_state.h"
#include "core/sim/tracked_frame.h"
#include "core/sim/world.h"
#include "core/spec/parameter.h"
#include "core/spec/require.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

using Input = Binding::Input;
using Measured = Binding::Measured;

/// What the recording says of the inputs in one row.
void setInputs(const Recording& recording, const Binding& binding, std::size_t row,
               std::vector<std::vector<JointInput>>& inputs) {
  for (const Input& input : binding.inputs) {
    const double value = inputFrom(recording, input, row);
    if (!std::isfinite(value)) continue;  // holds the last one
    JointInput& joint = inputs[input.robot][input.joint];
    switch (input.what) {
      case Input::What::command:
      case Input::What::motion:
        joint.command = value;
        break;
      case Input::What::enabled:
        joint.enabled = value > 0.5;
        break;
      case Input::What::supply:
        joint.supply_v = std::max(0.0, value);
        break;
      case Input::What::duty:
        joint.duty = value;
        break;
      case Input::What::volts:
        joint.duty = value < 0 ? -1 : 1;
        joint.supply_v = std::abs(value);
        break;
    }
  }
}

/// Simulated counterparts of the measured columns. Quaternions take the sign that is nearer to the recorded one.
/// `frame` is trackedFrame(scene), `robots` is scratch.
void readMeasured(const World& world, const Scene& scene, const Recording& recording, const Binding& binding,
                  const Eigen::Isometry3d& frame, std::size_t row, std::vector<RobotReadings>& robots,
                  std::vector<std::vector<double>>& values) {
  robots.resize(scene.robots.size());
  for (std::size_t i = 0; i < robots.size(); ++i) world.read(i, robots[i]);
  const auto orientation = [&](const Measured& measured) {
    const Eigen::Quaterniond q(robots[measured.object].base.linear());
    return std::array{q.w(), q.x(), q.y(), q.z()}[measured.part];
  };
  const auto agreement = [&](std::size_t robot) {
    double sum = 0;
    for (const Measured& measured : binding.measured)
      if (measured.what == Measured::What::baseOrientation && measured.object == robot &&
          std::isfinite(recording.columns[measured.column][row]))
        sum += orientation(measured) * recording.columns[measured.column][row];
    return sum;
  };

  for (std::size_t i = 0; i < binding.measured.size(); ++i) {
    const Measured& measured = binding.measured[i];
    double value = 0;
    switch (measured.what) {
      case Measured::What::position:
        value = robots[measured.object].position[measured.part];
        break;
      case Measured::What::rate:
        value = robots[measured.object].rate[measured.part];
        break;
      case Measured::What::torque:
        value = robots[measured.object].torque[measured.part];
        break;
      case Measured::What::basePosition:
        value = robots[measured.object].base.translation()[static_cast<int>(measured.part)];
        break;
      case Measured::What::baseOrientation:
        value = agreement(measured.object) < 0 ? -orientation(measured) : orientation(measured);
        break;
      case Measured::What::ballPosition:
        value = (frame * world.ball(measured.object).position_m)[static_cast<int>(measured.part)];
        break;
    }
    values[i][row] = value;
  }
}

/// Every input before the recording says anything: a servo holds where it starts, and one that nobody recorded where
/// the scene puts it.
std::vector<std::vector<JointInput>> restingInputs(const Scene& scene, const Binding& binding,
                                                   const StartState& start) {
  const auto recorded = recordedJoints(scene, binding);
  std::vector<std::vector<JointInput>> inputs;
  for (std::size_t robot = 0; robot < scene.robots.size(); ++robot) {
    inputs.emplace_back(scene.robots[robot].model.joints.size());
    for (std::size_t joint = 0; joint < inputs[robot].size(); ++joint) {
      const Drive::Kind kind = scene.robots[robot].drives[joint].kind;
      if (kind == Drive::Kind::servo || kind == Drive::Kind::motion)
        inputs[robot][joint].command =
            recorded[robot][joint] ? start.robots[robot].positions[joint] : scene.robots[robot].jointStart[joint];
      if (kind == Drive::Kind::dcMotor) inputs[robot][joint].duty = 0;
    }
  }
  return inputs;
}

/// Joints whose motion is prescribed, in a replay of rows `first` … `last` − 1.
class Prescribed {
 public:
  Prescribed(const Recording& recording, const Binding& binding, std::size_t first, std::size_t last)
      : recording_(recording), first_(first), last_(last) {
    for (const Input& input : binding.inputs)
      if (input.what == Input::What::motion) inputs_.push_back(input);
    torques_ = followedTorques(binding);
  }
  bool any() const { return !inputs_.empty(); }

  /// A step that covers every interval of the recording.
  double step() const {
    const auto& time = recording_.columns[0];
    double longest = 0;
    for (std::size_t row = first_; row + 1 < last_; ++row) longest = std::max(longest, time[row + 1] - time[row]);
    return longest;
  }

  void start(StartState& state) const {
    const auto& time = recording_.columns[0];
    for (const Input& input : inputs_) {
      const auto& path = recording_.columns[input.column];
      const auto slope = [&](std::size_t a, std::size_t b) { return (path[b] - path[a]) / (time[b] - time[a]); };
      // Rows at which the path is known: a channel may be there in some of them only.
      const auto knownFrom = [&](std::size_t row) {
        while (row < path.size() && !std::isfinite(path[row])) ++row;
        return row;
      };
      const std::size_t here = knownFrom(first_), next = knownFrom(here + 1), afterNext = knownFrom(next + 1);
      if (here >= path.size()) continue;
      std::size_t before = first_;  // first_: there is none
      for (std::size_t row = first_; row-- > 0 && before == first_;)
        if (std::isfinite(path[row])) before = row;
      state.robots[input.robot].positions[input.joint] =
          here > first_ && before < first_ ? path[before] + slope(before, here) * (time[first_] - time[before])
                                           : path[here];
      double rate = 0;
      if (before < first_ && next < path.size())
        rate = slope(before, next);
      else if (afterNext < path.size())
        rate = 2 * slope(here, next) - slope(here, afterNext);
      else if (next < path.size())
        rate = slope(here, next);
      state.robots[input.robot].rates[input.joint] = rate;
    }
  }

  /// A prescribed joint gets the position of the next row.
  void aim(std::size_t nextRow, std::vector<std::vector<JointInput>>& inputs) const {
    for (const Input& input : inputs_) {
      const double value = recording_.columns[input.column][nextRow];
      if (std::isfinite(value)) inputs[input.robot][input.joint].command = value;
    }
  }

  /// A torque that was read at the end of a step acted at its beginning.
  void align(std::vector<std::vector<double>>& values) const {
    for (const std::size_t i : torques_)
      for (std::size_t row = first_; row + 1 < last_; ++row) {
        values[i][row] = values[i][row + 1];
      }
  }

  /// As the recorded ones are; the ends of a window know nothing of what is beside it.
  void filter(std::vector<std::vector<double>>& values) const {
    if (first_ != 0 || last_ != recording_.rows()) return;
    for (const std::size_t i : torques_) filterAsCompared(recording_, values[i]);
  }

 private:
  const Recording& recording_;
  std::size_t first_, last_;
  std::vector<Input> inputs_;
  std::vector<std::size_t> torques_;
};

/// Calls action(joint, whether its rate is what the slope of its positions says) for each joint of a robot whose
/// position the recording has.
void forJointsSeen(const Binding& binding, std::size_t robot, const auto& action) {
  const auto isRateKnown = [&](const Measured& position) {
    return std::ranges::any_of(binding.measured, [&](const Measured& other) {
      return other.what == Measured::What::rate && other.object == robot && other.part == position.part;
    });
  };
  for (const auto* list : {&binding.measured, &binding.startOnly})
    for (const Measured& measured : *list)
      if (measured.what == Measured::What::position && measured.object == robot)
        action(measured.part, !isRateKnown(measured));
}

/// Puts all robots where a start says and makes them forget. A start is what the sensors said: where an effect puts a
/// sensor off, the joint itself stands elsewhere and moves faster or slower, unless its motion is prescribed.
void stand(World& world, const Binding& binding, const StartState& start, bool prescribed) {
  constexpr double small = 1e-4, same = 1e-12, sameSlope = 1e-9;
  constexpr int rounds = 4;  // of Newton's method; one does for what is straight
  for (std::size_t i = 0; i < start.robots.size(); ++i) {
    const StartState::Robot& robot = start.robots[i];
    std::vector<double> positions = robot.positions, rates = robot.rates;
    const auto saidAt = [&](const std::vector<double>& at) {
      world.setRobot(i, robot.base, robot.velocity_m_s, robot.spin_rad_s, at, rates);
      return world.robot(i).position;
    };
    std::vector<double> said = saidAt(positions);
    if (prescribed) continue;
    for (int round = 0; round < rounds; ++round) {
      bool isThere = true;
      forJointsSeen(binding, i, [&](std::size_t j, bool) {
        isThere = isThere && !(std::abs(said[j] - robot.positions[j]) > (round > 0 ? same : 0));
      });
      if (isThere) break;
      std::vector<double> next = positions;
      for (double& position : next) position += small;
      const std::vector<double> there = saidAt(next), from = positions;
      forJointsSeen(binding, i, [&](std::size_t j, bool bySlope) {
        double slope = (there[j] - said[j]) / small;
        if (!(slope > 0) || std::abs(slope - 1) < sameSlope) slope = 1;
        positions[j] = from[j] - (said[j] - robot.positions[j]) / slope;
        if (bySlope) rates[j] = robot.rates[j] / slope;
      });
      said = saidAt(positions);
    }
  }
}

/// How much faster a robot's joints are than their sensors say, from here on.
class AheadOfSensors {
 public:
  AheadOfSensors(const World& world, const Binding& binding, std::size_t robot)
      : binding_(binding), robot_(robot), before_(offOf(world)) {}
  /// True if any has moved otherwise than its sensor said.
  bool parted(const World& world) const { return offOf(world) != before_; }
  /// Moves the robot to where its sensors say what `said` says, `dt` after the beginning [s]. Where the recording has a
  /// joint's position alone, `said` has the rate of that; the joint's own is as much faster as it was.
  void move(World& world, const StartState& said, double dt) const {
    const StartState::Robot& robot = said.robots[robot_];
    const std::vector<double> off = offOf(world);
    std::vector<double> rates = robot.rates;
    forJointsSeen(binding_, robot_, [&](std::size_t j, bool bySlope) {
      if (bySlope) rates[j] = robot.rates[j] + (off[j] - before_[j]) / dt;
    });
    world.moveRobot(robot_, robot.base, robot.velocity_m_s, robot.spin_rad_s, robot.positions, rates);
  }

 private:
  std::vector<double> offOf(const World& world) const {
    std::vector<double> off = world.jointPositions(robot_);
    const std::vector<double> said = world.robot(robot_).position;
    for (std::size_t j = 0; j < off.size(); ++j) off[j] -= said[j];
    return off;
  }

  const Binding& binding_;
  std::size_t robot_;
  std::vector<double> before_;
};

/// A start is where the recording has the balls; in the scene's own frame they are elsewhere. One that lies on the
/// floor lies there in both.
void putBalls(World& world, const Scene& scene, const std::vector<BallState>& recorded) {
  const Eigen::Isometry3d frame = trackedFrame(scene), back = frame.inverse();
  const bool isSame = frame.matrix() == Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    BallState ball = recorded[i];
    if (!isSame) {
      ball.position_m = back * ball.position_m;
      ball.velocity_m_s = back.linear() * ball.velocity_m_s;
      ball.spin_rad_s = back.linear() * ball.spin_rad_s;
      if (ball.onFloor) ball.position_m.z() = ball.radius_m, ball.velocity_m_s.z() = 0;
    }
    world.setBall(i, ball);
  }
}

/// Whether anything remembers: its next steps follow from more than where everything is and how it moves.
bool remembers(const Scene& scene) {
  const auto isWound = [](const Drive& drive) { return drive.i != 0 || drive.hasGear(); };
  return std::ranges::any_of(scene.effects, [](const SceneEffect& e) { return e.effect->stateSize() > 0; }) ||
         std::ranges::any_of(scene.robots, [&](const SceneRobot& r) { return std::ranges::any_of(r.drives, isWound); });
}

/// Where a window that begins in the middle is run in from: what a delay, play or an elastic gear remembers there no
/// recording says.
struct Earlier {
  std::size_t row;
  StartState state;
};

std::optional<Earlier> beforeWindow(const Scene& scene, const Recording& recording, const Binding& binding,
                                    std::size_t first) {
  constexpr double runIn_s = 0.3;
  if (first == 0 || !remembers(scene)) return std::nullopt;
  const std::vector<double>& time = recording.columns[0];
  std::size_t row = first;
  while (row > 0 && time[first] - time[row] < runIn_s) --row;
  return Earlier{row, startState(scene, recording, binding, row)};
}

}  // namespace

ReplayedRecording replayRecording(const Scene& given, const Recording& recording, const Binding& binding,
                                  const StartState& from, std::size_t first, std::size_t last,
                                  const std::function<bool()>& goesOn) {
  constexpr std::uint64_t seed = 1;  // nothing in a replay is drawn by chance
  constexpr std::size_t rowsBetweenQuestions = 256;
  const std::size_t rows = recording.rows();
  last = std::min(last, rows);
  require(first < last, "a replay of at least one row");
  ReplayedRecording replayed;
  replayed.values.assign(binding.measured.size(), std::vector<double>(rows, std::numeric_limits<double>::quiet_NaN()));

  const Prescribed prescribed(recording, binding, first, last);
  Scene scene = given;
  StartState start = from;
  if (prescribed.any()) {
    scene.step_s = prescribed.step();
    prescribed.start(start);
  }

  const std::optional<Earlier> earlier =
      prescribed.any() ? std::nullopt : beforeWindow(scene, recording, binding, first);
  World world(scene, seed);
  const Eigen::Isometry3d frame = trackedFrame(scene);
  auto inputs = restingInputs(scene, binding, start);
  for (const Input& input : binding.inputs)
    if (input.what == Input::What::command)
      inputs[input.robot][input.joint].duty = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double>& time = recording.columns[0];
  const std::size_t begins = earlier ? earlier->row : first;
  world.startAt(time[begins] - time[0]);

  const auto begin = [&](const StartState& state) {
    stand(world, binding, state, prescribed.any());
    for (std::size_t i = 0; i < scene.robots.size(); ++i)
      if (state.robots[i].rests) world.rest(i);
    putBalls(world, scene, state.balls);
  };
  begin(earlier ? earlier->state : start);
  // Inputs of a window that begins in the middle: the last ones that were given.
  for (std::size_t row = 0; row < begins; ++row) setInputs(recording, binding, row, inputs);
  if (earlier) {
    for (std::size_t row = begins; row < first; ++row) {
      std::vector<AheadOfSensors> ahead;
      if (row == begins || row + 1 == first)
        for (std::size_t i = 0; i < scene.robots.size(); ++i) ahead.emplace_back(world, binding, i);
      setInputs(recording, binding, row, inputs);
      const double dt = time[row + 1] - time[row];
      world.advance(inputs, dt);
      if (row + 1 == first) {
        for (const AheadOfSensors& each : ahead) each.move(world, start, dt);
      } else if (row == begins && std::ranges::any_of(ahead, [&](const auto& each) { return each.parted(world); })) {
        // By now it is known how much faster than their sensors say the joints were at the beginning, too.
        const StartState there = startState(scene, recording, binding, row + 1);
        for (const AheadOfSensors& each : ahead) each.move(world, there, dt);
      }
    }
    putBalls(world, scene, start.balls);
  }

  std::vector<RobotReadings> robots;
  for (std::size_t row = first; row < last; ++row) {
    if (goesOn && (row - first) % rowsBetweenQuestions == 0 && !goesOn()) throw Cancelled{};
    readMeasured(world, scene, recording, binding, frame, row, robots, replayed.values);
    setInputs(recording, binding, row, inputs);
    if (row + 1 == last) break;
    prescribed.aim(row + 1, inputs);
    world.advance(inputs, time[row + 1] - time[row]);
    replayed.fault = world.fault();
    if (!replayed.fault.empty()) {
      replayed.fault += ", at " + toText(time[row + 1]) + " s";
      break;
    }
  }
  prescribed.align(replayed.values);
  prescribed.filter(replayed.values);
  return replayed;
}

}  // namespace btr
