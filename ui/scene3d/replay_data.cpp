#include "ui/scene3d/replay_data.h"

#include "core/model/kinematics.h"
#include "core/spec/error.h"
#include "ui/scene3d/ball_roll.h"

namespace btr::ui {

ReplayData toReplayData(const Replay& replay, std::vector<ReplayBall> balls, const QString& title,
                        const QString& fitnessUnit) {
  ReplayData data;
  data.trace = replay.result.trace;
  for (const Replay::Robot& robot : replay.robots) data.others.push_back({robot.name, robot.model, robot.start});
  if (!data.others.empty()) {
    data.robotName = data.others.front().name;
    data.model = data.others.front().model;
    data.fixedBase = data.others.front().fixedBase;
    data.others.erase(data.others.begin());
  }
  data.balls = std::move(balls);
  const std::size_t simulated = data.trace.rows();
  if (replay.result.outcome == TrialResult::Outcome::finished)
    for (std::size_t i = 0; i < data.balls.size() && i < replay.result.balls.size(); ++i)
      appendRoll(data.trace, data.balls[i].name, data.balls[i].radius_m, replay.result.balls[i].rest_m);
  if (const int time = data.trace.column("time_s"); data.trace.rows() > simulated && time >= 0)
    data.rollsFrom_s = data.trace.at(simulated - 1, static_cast<std::size_t>(time));
  data.title = title;
  data.check = replay.identical ? ReplayData::Check::identical : ReplayData::Check::differs;
  data.fitness = replay.fitness;
  data.storedFitness = replay.storedFitness;
  data.fitnessUnit = fitnessUnit;
  if (replay.result.outcome != TrialResult::Outcome::finished)
    data.note = QString::fromUtf8(toText(replay.result.outcome)) + ": " + QString::fromStdString(replay.result.detail);
  return data;
}

ReplayFrames::ReplayFrames(const ReplayData& data) : trace_(data.trace) {
  const int time = trace_.column("time_s");
  if (time < 0) throw InputError("trace of " + data.title.toStdString() + ": no column time_s");
  for (std::size_t row = 0; row < trace_.rows(); ++row) {
    times_.push_back(trace_.at(row, time));
    if (row > 0 && !(times_[row] > times_[row - 1]))
      throw InputError("trace of " + data.title.toStdString() + " row " + std::to_string(row + 1) + " time_s",
                       std::to_string(times_[row]), "times increase");
  }
  first_ = columnsOf(trace_, {data.robotName, data.model, data.fixedBase});
  for (const ReplayRobot& robot : data.others) {
    others_.push_back(columnsOf(trace_, robot));
    otherModels_.push_back(robot.model);
  }
  for (const ReplayBall& ball : data.balls) {
    const PoseColumns columns = find(trace_, ball.name);
    if (columns.column[0] < 0) continue;
    balls_.push_back(columns);
    radii_.push_back(ball.radius_m);
  }
}

ReplayFrames::RobotColumns ReplayFrames::columnsOf(const Trace& trace, const ReplayRobot& robot) {
  RobotColumns columns{robot.model, robot.fixedBase, find(trace, robot.name + ".base"), {}};
  if (robot.model)
    for (const Joint& joint : robot.model->joints) {
      const bool slides = joint.type == Joint::Type::slide;
      columns.joints.push_back(
          trace.column(robot.name + "." + joint.name + (slides ? ".position_m" : ".position_rad")));
    }
  return columns;
}

std::vector<Eigen::Isometry3d> ReplayFrames::linksOf(std::size_t row, const RobotColumns& robot) const {
  if (!robot.model) return {};
  std::vector<double> positions;
  for (int column : robot.joints)
    positions.push_back(column < 0 ? 0 : trace_.at(row, static_cast<std::size_t>(column)));
  return forwardKinematics(*robot.model, robot.base.column[0] < 0 ? robot.fixedBase : read(row, robot.base), positions);
}

ReplayFrames::PoseColumns ReplayFrames::find(const Trace& trace, const std::string& prefix) {
  PoseColumns result{};
  const char* names[] = {".x_m", ".y_m", ".z_m", ".qw", ".qx", ".qy", ".qz"};
  for (int i = 0; i < 7; ++i) result.column[i] = trace.column(prefix + names[i]);
  return result;
}

Eigen::Isometry3d ReplayFrames::read(std::size_t row, const PoseColumns& columns) const {
  const auto value = [&](int i, double otherwise) {
    return columns.column[i] < 0 ? otherwise : trace_.at(row, static_cast<std::size_t>(columns.column[i]));
  };
  Eigen::Isometry3d pose(Eigen::Translation3d(value(0, 0), value(1, 0), value(2, 0)));
  const Eigen::Quaterniond turn(value(3, 1), value(4, 0), value(5, 0), value(6, 0));
  if (turn.norm() > 1e-6) pose.linear() = turn.normalized().toRotationMatrix();
  return pose;
}

ScenePose ReplayFrames::pose(std::size_t frame) const {
  ScenePose result;
  result.links = linksOf(frame, first_);
  for (const RobotColumns& robot : others_) result.others.push_back(linksOf(frame, robot));
  for (const PoseColumns& columns : balls_) result.balls.push_back(read(frame, columns));
  return result;
}

}  // namespace btr::ui
