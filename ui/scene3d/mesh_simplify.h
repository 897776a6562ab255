#pragma once
#include "ui/scene3d/triangle_mesh.h"

namespace btr::ui {

/// The same surface with fewer triangles, for where it is small in a picture: corners are taken away as long as the
/// planes that met there lie no further than `error_m` (root mean square over their areas) from what is left. Corners
/// that stay keep their place, normals and colours; edges of colours and of open surfaces stay where they are within
/// the same error. The same mesh gives the same triangles. Source of the measure: M. Garland, P. S. Heckbert, Surface
/// simplification using quadric error metrics, SIGGRAPH 1997; here an edge is drawn together into one of its ends.
TriangleMesh simplified(const TriangleMesh& mesh, double error_m);

}  // namespace btr::ui
