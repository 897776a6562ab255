#pragma once
#include "core/spec/carpet_spec.h"
#include "ui/scene3d/triangle_mesh.h"

namespace btr::ui {

/// The four-legged league's field of 2004, in m, its middle at the origin and the goals along x. Numbers marked (e) are
/// estimates where no drawing was found. The outer wall is drawn only 60 mm high (e): its 300 mm would hide the play.
struct FieldSize {
  double length = 4.2, width = 2.7;  ///< outer edges of the border lines
  double line = 0.025;
  double circle = 0.30;                             ///< diameter
  double penaltyDepth = 0.45, penaltyWidth = 0.90;  ///< (e) the 2005 area, scaled
  double goalWidth = 0.60, goalHeight = 0.30, goalDepth = 0.30, goalPanel = 0.012;
  double beaconX = 2.20, beaconY = 1.45, beaconHeight = 0.40, beaconDiameter = 0.10;  ///< diameter (e)
  double carpetX = 2.60, carpetY = 1.70;  ///< (e) half the carpet's length and width
  double wallHeight = 0.06, wallThickness = 0.02;
};

/// Parts of the field, apart because they are shaded differently.
TriangleMesh fieldCarpet(const FieldSize& size);
TriangleMesh fieldLines(const FieldSize& size);     ///< half a millimetre above the carpet
TriangleMesh fieldFixtures(const FieldSize& size);  ///< goals and beacons
TriangleMesh fieldWall(const FieldSize& size);

/// A scene's own carpet and what is painted on it, half a millimetre above.
TriangleMesh carpetCloth(const CarpetSpec& carpet);
TriangleMesh carpetLines(const CarpetSpec& carpet);

/// An endless-looking floor, and lines every 0.1 m and 0.5 m on it.
TriangleMesh plainFloor(double halfWidth, double z, const Colour& colour);
TriangleMesh floorGrid(double halfWidth, const Colour& colour);

}  // namespace btr::ui
