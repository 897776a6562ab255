#pragma once
#include <osg/Geometry>

#include "ui/scene3d/triangle_mesh.h"

namespace btr::ui {

/// Arrays are drawn from buffers of the driver.
void useBuffers(osg::Geometry& geometry);
/// `gloss`: strength of the highlight.
osg::ref_ptr<osg::Geometry> toGeometry(const TriangleMesh& mesh, float gloss);
/// The same, and the same with fewer triangles for where it is smaller: what is drawn is off by at most
/// `mostError_px`, root mean square. A camera's LOD scale tells how large a pixel is [m for each m of distance]; 0
/// draws the mesh itself.
osg::ref_ptr<osg::Node> toLevels(const TriangleMesh& mesh, float gloss);
inline constexpr double mostError_px = 0.2;

}  // namespace btr::ui
