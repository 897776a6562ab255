#pragma once
#include <QStringList>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/live/game.h"
#include "core/sim/scene.h"
#include "ui/scene3d/scene_builder.h"
#include "ui/scene3d/world_marks.h"

namespace btr::ui {

/// A line that a robot's program said; of the program itself: without an object.
struct ProgramLine {
  QString robot, object, text;
};

/// Of a log that is played again, see LogReplay.
struct LiveReplay {
  long sameUntil = 0;
  std::optional<long> differsBy;
  bool over = false;
};

/// What a running session tells of one moment.
struct LiveRow {
  std::vector<double> values;  ///< by channel
  long period = 0;
  bool playing = false;
  double realTimeFactor = 0;
  std::vector<std::pair<std::size_t, Eigen::Isometry3d>> fixed;  ///< obstacles that never move: number and pose
  QString fault;
  std::optional<std::array<int, 2>> score;         ///< red, blue; none without a referee
  double clock_s = 0;                              ///< of the referee
  std::map<std::string, Eigen::Vector3d> hands_n;  ///< by object that is pulled: the force [N], world axes
  std::vector<WorldMarks::Contact> contacts;       ///< of the last step, if they were asked for
  QStringList events;                              ///< since the last row: "goal of red" …
  std::map<std::string, Orders> orders;            ///< by robot with a program: motor power and lamps
  std::vector<ProgramLine> console;                ///< since the last row
  std::optional<LiveReplay> replay;                ///< none of a session that hands reach into
  /// By robot with a program, when that changed: "" it runs, else why no longer.
  std::optional<std::map<std::string, QString>> programs;
};

/// An object of a game, as it is picked, moved and listed.
struct LiveObject {
  enum class Kind { robot, ball, obstacle };
  std::string name;
  Kind kind = Kind::robot;
  double radius_m = 0.05;                            ///< of a sphere about its place that holds most of it
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();  ///< of an obstacle: half the edges of the box around it
  bool moves = true;
  double footprint_m = 0;  ///< of a robot: radius of the disc about its place that it covers
};

/// A game's objects as the 3D view draws them, and the columns of its rows. Robots come first, then obstacles, as
/// further robots of the view; the view's own robot is none.
class LiveScene {
 public:
  LiveScene() = default;
  LiveScene(const Game& game, const ModelSet& models, const std::vector<std::string>& channels);

  const std::vector<LiveObject>& objects() const { return objects_; }
  const std::vector<std::shared_ptr<const RobotModel>>& models() const { return models_; }
  const std::vector<std::string>& jackets() const { return jackets_; }  ///< of each of the models
  /// Of the links of a robot, each in its link's frame.
  const std::vector<Eigen::AlignedBox3d>& linkBoxes(std::size_t object) const { return boxes_.at(numbers_[object]); }
  /// Where the links of a robot are.
  std::vector<Eigen::Isometry3d> linksOf(std::size_t object, const LiveRow& row) const;
  /// What all objects fill.
  Eigen::AlignedBox3d box(const LiveRow& row) const;
  const std::vector<double>& radii() const { return radii_; }
  const std::optional<CarpetSpec>& carpet() const { return carpet_; }

  ScenePose pose(const LiveRow& row) const;
  /// Of an object's own frame; a robot's is its root link's.
  Eigen::Isometry3d poseOf(std::size_t object, const LiveRow& row) const;
  /// The row `part` of the way from one to a later one; everything moves evenly, turns take the shorter way.
  LiveRow between(const LiveRow& from, const LiveRow& to, double part) const;
  /// Where a robot's joints are, those that have a channel [rad or m].
  Values jointsOf(std::size_t object, const LiveRow& row) const;
  /// Time of the row [s].
  double time_s(const LiveRow& row) const { return row.values.empty() ? 0 : row.values[0]; }

 private:
  struct Columns {
    int pose = -1;  ///< the first of x, y, z, qw, qx, qy, qz
    std::vector<int> joints;
  };
  Eigen::Isometry3d read(const LiveRow& row, int column) const;

  std::vector<LiveObject> objects_;
  std::vector<std::size_t> numbers_;  ///< among those of its kind, by object
  std::vector<Columns> robots_;
  std::vector<int> balls_, obstacles_;
  std::vector<std::shared_ptr<const RobotModel>> models_;
  std::vector<std::string> jackets_;
  std::vector<std::vector<Eigen::AlignedBox3d>> boxes_;  ///< by robot and link
  std::vector<double> radii_;
  std::optional<CarpetSpec> carpet_;
};

}  // namespace btr::ui
