#pragma once
#include <QMetaType>
#include <QString>
#include <memory>
#include <string>
#include <vector>

#include "core/model/robot_model.h"
#include "core/run/replay.h"
#include "core/sim/trace.h"
#include "ui/scene3d/scene_builder.h"

namespace btr::ui {

/// A robot beside the first one.
struct ReplayRobot {
  std::string name;
  std::shared_ptr<const RobotModel> model;
  Eigen::Isometry3d fixedBase = Eigen::Isometry3d::Identity();
};

struct ReplayBall {
  std::string name = "ball";  ///< prefix of its channels
  double radius_m = 0.0425;
};

/// Everything that the replay panel shows, as plain values. Made in a worker thread, shown in the window's.
struct ReplayData {
  enum class Check { notChecked, identical, differs };

  Trace trace;
  std::shared_ptr<const RobotModel> model;  ///< null: balls only
  std::string robotName;                    ///< prefix of its channels
  /// Where the root link is when the trace has no base channels (a robot bolted to the ground).
  Eigen::Isometry3d fixedBase = Eigen::Isometry3d::Identity();
  std::vector<ReplayRobot> others;  ///< further robots of the scene
  std::vector<ReplayBall> balls;
  Ground ground = Ground::field;
  QString title;         ///< "kick-short, run 1, individual 17"
  QString simulator;     ///< "simulator 3"; empty: not shown
  bool standIn = false;  ///< reality was played by another simulation: always labelled
  Check check = Check::notChecked;
  double fitness = 0;
  double storedFitness = 0;
  bool fitnessHidden = false;  ///< somebody measures it blind
  QString fitnessUnit;
  double rollsFrom_s = -1;  ///< from then on the ball rolls out by the closed form; −1: the trial shows all
  QString note;             ///< a failed trial's reason, or empty
  /// Another trial that is shown beside this one, at the same time of its own; null: none.
  std::shared_ptr<const ReplayData> beside;
};

/// What core/run says of a stored individual, with the words and sizes that it does not know.
ReplayData toReplayData(const Replay& replay, std::vector<ReplayBall> balls, const QString& title,
                        const QString& fitnessUnit);

/// Rows of a trace as poses. The columns are looked up once. Robots without base channels stand at fixedBase; joints
/// without a position channel stay at 0; a ball without channels is not drawn.
class ReplayFrames {
 public:
  ReplayFrames() = default;
  /// Throws InputError if the trace has no time_s column or a row's times do not increase.
  explicit ReplayFrames(const ReplayData& data);

  const std::vector<double>& times() const { return times_; }
  ScenePose pose(std::size_t frame) const;
  /// Radii of the balls that pose() gives, in its order.
  const std::vector<double>& ballRadii() const { return radii_; }
  /// Models of the robots whose links pose() gives as `others`.
  const std::vector<std::shared_ptr<const RobotModel>>& otherModels() const { return otherModels_; }

 private:
  /// Columns of x, y, z, qw, qx, qy, qz, or −1.
  struct PoseColumns {
    int column[7];
  };
  static PoseColumns find(const Trace& trace, const std::string& prefix);
  Eigen::Isometry3d read(std::size_t row, const PoseColumns& columns) const;

  /// One robot's columns.
  struct RobotColumns {
    std::shared_ptr<const RobotModel> model;
    Eigen::Isometry3d fixedBase = Eigen::Isometry3d::Identity();
    PoseColumns base{};
    std::vector<int> joints;
  };
  static RobotColumns columnsOf(const Trace& trace, const ReplayRobot& robot);
  std::vector<Eigen::Isometry3d> linksOf(std::size_t row, const RobotColumns& robot) const;

  Trace trace_;
  RobotColumns first_;
  std::vector<RobotColumns> others_;
  std::vector<std::shared_ptr<const RobotModel>> otherModels_;
  std::vector<PoseColumns> balls_;
  std::vector<double> radii_, times_;
};

}  // namespace btr::ui

Q_DECLARE_METATYPE(btr::ui::ReplayData)
