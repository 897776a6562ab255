#pragma once
#include <Eigen/Core>
#include <QString>
#include <string>
#include <variant>
#include <vector>

#include "core/spec/scene_spec.h"

namespace btr::ui {
class LiveWorld;

/// Something that can be put into a world. A robot's file is read only when it is added.
struct ThingToAdd {
  std::string word;  ///< its name begins with this
  QString text;
  std::variant<BallSpec, ObstacleSpec, QString> what;  ///< QString: a robot's file
};

/// A ball, obstacles, the robots that come with the program.
std::vector<ThingToAdd> thingsToAdd();
ThingToAdd robotToAdd(const QString& file);

/// Puts one on the floor, at the free place nearest to the wished one [m], and selects it. Throws InputError for a
/// robot's file that cannot be read.
void addThing(LiveWorld& world, const ThingToAdd& thing, const Eigen::Vector2d& wished);

}  // namespace btr::ui
