#pragma once
#include "core/model/robot_model.h"
#include "ui/scene3d/triangle_mesh.h"
#include "ui/scene3d/world_marks.h"

namespace btr::ui {

/// Lines that explain a link, in its own frame [m].
struct LinkMarks {
  LineSegments box;     ///< around everything that is drawn
  LineSegments axes;    ///< of the joint that moves it, and a pointer that shows how far it is turned
  LineSegments limits;  ///< of the joints that it carries: an arc, or a rod, from the lower to the upper limit
  LineSegments centre;  ///< a cross at the centre of mass whose size goes with the cube root of the mass
};

/// By link of the model.
std::vector<LinkMarks> marksOf(const RobotModel& model);

/// A cross where bodies touch, and the force as a line: 10 mm a newton, at most 0.3 m.
LineSegments contactLines(const std::vector<WorldMarks::Contact>& contacts);
LineSegments trailLines(const std::vector<std::vector<Eigen::Vector3f>>& trails);

}  // namespace btr::ui
