#pragma once
#include <Eigen/Geometry>
#include <QColor>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/robot_model.h"
#include "core/spec/carpet_spec.h"
#include "ui/scene3d/renderer.h"
#include "ui/scene3d/world_marks.h"

namespace btr::ui {

/// Where everything that moves is at one moment, in the world's frame.
struct ScenePose {
  std::vector<Eigen::Isometry3d> links;  ///< by link of the model; fewer than the model has: no robot is drawn
  std::vector<Eigen::Isometry3d> balls;
  std::vector<std::vector<Eigen::Isometry3d>> others;  ///< links of the further robots
};

/// A second, translucent robot and its balls, to compare with the solid ones.
struct Ghost {
  ScenePose pose;
  QColor colour{60, 130, 230, 110};
};

enum class Ground { field, plain, none };

/// How bodies are drawn.
enum class Surfaces { shaded, wireframe, points, transparent };

/// Lines that are drawn besides: outlines of what collides, boxes around links, joint axes with limits, centres of
/// mass, contacts with their forces, ways that were gone.
enum class Mark { collision, boxes, axes, centres, contacts, trails };
inline constexpr std::size_t kMarks = 6;

/// Robot, balls and ground as an OpenSceneGraph scene. Owns the graph; a graph belongs to one thread.
class SceneBuilder {
 public:
  SceneBuilder();
  ~SceneBuilder();
  SceneBuilder(const SceneBuilder&) = delete;
  SceneBuilder& operator=(const SceneBuilder&) = delete;

  osg::Node& node() const;

  /// Draws the model's drawn shapes; null takes the robot away. Poses are forgotten.
  void setRobot(std::shared_ptr<const RobotModel> model);
  /// Robots also get bodies of fewer triangles, which are drawn where they are small in the picture (see toLevels).
  /// Poses are forgotten.
  void setLevels(bool levels);
  /// Robots beside the first one, whose poses are ScenePose::others.
  void setFurtherRobots(std::vector<std::shared_ptr<const RobotModel>> models);
  /// One ball a radius [m]. Poses are forgotten.
  void setBalls(std::vector<double> radii_m);
  void setPose(const ScenePose& pose);
  const ScenePose& pose() const;
  void setGhosts(std::vector<Ghost> ghosts);

  void setGround(Ground ground);
  /// Lies on a plain ground instead of its grid; none: the grid again.
  void setCarpet(std::optional<CarpetSpec> carpet);
  /// Shapes of a part with this word are drawn, those of the other jacket are not: "red" or "blue".
  void setJacket(const std::string& part);
  /// Jackets of the further robots, for each its own; "" or none: the first robot's.
  void setFurtherJackets(std::vector<std::string> parts);
  void setSurfaces(Surfaces surfaces);
  void setMark(Mark mark, bool on);
  /// Contacts and trails, drawn while their marks are on.
  void setWorldMarks(WorldMarks marks);
  /// Floor and sky for a dark window.
  void setDark(bool dark);
  /// What a picture from a robot's own camera leaves out: a link of a further robot, its head. None: all is drawn.
  void hideLink(std::optional<std::pair<std::size_t, std::size_t>> furtherRobotAndLink);

  /// Numbers of objects in a measurement, see EyeRenderer.
  static constexpr std::uint16_t groundNumber() { return 1; }
  std::uint16_t furtherNumber(std::size_t further) const;
  std::uint16_t ballNumber(std::size_t ball) const;
  /// Sky colours that go with it; shadows and supersampling as by default.
  RenderOptions renderOptions() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::ui
