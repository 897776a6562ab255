#include "core/gap/fit/joint_pace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/sample_speed.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

double largestTorque(const Drive& drive) {
  constexpr double unlimited = 1e8;
  if (drive.kind == Drive::Kind::servo && drive.maxTorque < unlimited) return drive.maxTorque;
  if (drive.kind == Drive::Kind::dcMotor && drive.supply_v > 0)
    return drive.torqueConstant_nm_a * drive.supply_v * drive.maxDuty / drive.resistance_ohm;
  return std::numeric_limits<double>::infinity();
}

/// Whether one of the drive's numbers that a fit may change makes its largest torque another one.
bool isTorqueFitted(const FitProblem& problem, const std::string& at, const Binding::Measured& joint, double asGiven) {
  const std::string robot = at.substr(0, at.find('.')), name = at.substr(robot.size() + 1);
  return std::ranges::any_of(problem.scene.calibrate, [&](const CalibratePath& path) {
    return path.path.starts_with("robots." + robot + ".servos." + name + ".") &&
           std::ranges::any_of(std::array{path.minimum, path.maximum}, [&](double value) {
             SimulatorSpec moved = problem.given;
             moved.values[path.path] = value;
             return largestTorque(problem.sceneOf(moved, 0).robots[joint.object].drives[joint.part]) != asGiven;
           });
  });
}

/// The power of the rate by which a torque per rate is multiplied; nothing for what is no torque.
std::optional<int> powerOfRate(const std::string& unit) {
  if (unit == "N·m") return 0;
  if (unit == "N·m·s/rad") return 1;
  if (unit == "N·m·s²/rad²") return 2;
  return std::nullopt;
}

}  // namespace

std::map<std::string, JointPace> pacesOf(const FitProblem& problem) {
  std::map<std::string, JointPace> paces;
  std::map<std::string, double> counts;
  const Scene scene = problem.sceneOf(problem.given, 0);
  for (const FitTrial& trial : problem.trials)
    for (std::size_t c = 0; c < trial.binding.measured.size(); ++c) {
      const Measured& measured = trial.binding.measured[c];
      if (measured.what != Measured::What::position && measured.what != Measured::What::rate) continue;
      const SceneRobot& robot = scene.robots[measured.object];
      const std::string at = robot.name + "." + robot.model.joints[measured.part].name;
      const auto [place, isNew] = paces.try_emplace(at);
      JointPace& pace = place->second;
      if (isNew) {
        pace.torque = largestTorque(robot.drives[measured.part]);
        pace.torqueIsFitted = isTorqueFitted(problem, at, measured, pace.torque);
      }
      const std::vector<double> speeds = measured.what == Measured::What::rate
                                             ? trial.recording.columns[measured.column]
                                             : sampleSpeeds(trial.recording, measured.column, trial.noiseFloor[c]);
      for (const double speed : speeds)
        if (std::isfinite(speed)) {
          pace.rate += speed * speed;
          ++counts[at];
        }
    }
  for (auto& [at, pace] : paces) pace.rate = counts[at] > 0 ? std::sqrt(pace.rate / counts[at]) : 0;
  return paces;
}

Parameter inProportion(const FitProblem& problem, const std::string& at, Parameter parameter) {
  constexpr double outOfProportion = 10, typical = 0.1, weaker = 0.8;  // of what the drive gives [hand]
  const auto pace = problem.paces.find(at);
  if (pace == problem.paces.end() || !parameter.neutral) return parameter;
  const double torque = pace->second.torque;
  if (!(torque > 0)) return parameter;
  if (parameter.unit == "1/(N·m)" && weaker * torque * parameter.maximum > 1) {
    if (!pace->second.torqueIsFitted) {
      parameter.minimum = std::max(parameter.minimum, 1 / torque);
      parameter.neutral = parameter.minimum;
    }
    if (std::isfinite(torque)) parameter.byDefault = 1 / (weaker * torque);
  } else if (const auto power = powerOfRate(parameter.unit)) {
    const double size = parameter.byDefault - *parameter.neutral;
    const double usual = std::abs(size) * std::pow(pace->second.rate, *power);
    if (usual > outOfProportion * torque) parameter.byDefault = *parameter.neutral + size * typical * torque / usual;
  }
  return parameter;
}

}  // namespace btr
