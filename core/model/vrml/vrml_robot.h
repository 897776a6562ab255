#pragma once
#include "core/model/vrml/vrml_tree.h"

namespace btr::vrml {

/// Finds the one Humanoid of a document and makes a robot of it. How the file is understood:
/// - A Joint and the Segments in it make one Link, named after the first Segment (DEF, else its name field). Segments
/// may
///   stand in Joints, Joints in Segments, and grouping nodes between them all. A Joint is named by DEF, else by its
///   name.
/// - The outermost Joint is the root ("free" or "fixed"); where it stands is the scene's business.
/// - What `Segment.children` shows is drawn. `Segment.collision` (ours, MFNode) holds what collides and isn't drawn; an
///   empty list means that nothing collides. Without the field all that is drawn collides. Where a link collides with
///   primitives and with meshes, the scene chooses: meshes are the alternative to the primitives, never added to them.
/// - `Part { name choice }` (ours) marks shapes by a word for switching variants ("red", "blue"); all choices are read.
/// - A VisionSensor looks along its own −z axis with +y up, as in OpenHRP.
RobotModel extractRobot(Document& document, const ModelBudget& budget);

}  // namespace btr::vrml
