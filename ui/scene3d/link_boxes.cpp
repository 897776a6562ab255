#include "ui/scene3d/link_boxes.h"

#include "ui/scene3d/triangle_mesh.h"

namespace btr::ui {

using Eigen::AlignedBox3d;

std::vector<AlignedBox3d> linkBoxes(const RobotModel& model) {
  std::vector<AlignedBox3d> boxes;
  for (const Link& link : model.links) {
    TriangleMesh mesh;
    for (const Shape& shape : link.shapes)
      if (shape.drawn) mesh.addShape(shape, shape.pose, {1, 1, 1, 1});
    AlignedBox3d& box = boxes.emplace_back();
    for (const Eigen::Vector3f& place : mesh.positions) box.extend(place.cast<double>());
  }
  return boxes;
}

AlignedBox3d boxOf(const std::vector<AlignedBox3d>& links, const std::vector<Eigen::Isometry3d>& poses) {
  AlignedBox3d all;
  for (std::size_t i = 0; i < links.size() && i < poses.size(); ++i)
    for (int corner = 0; corner < 8 && !links[i].isEmpty(); ++corner)
      all.extend(poses[i] * links[i].corner(static_cast<AlignedBox3d::CornerType>(corner)));
  return all;
}

}  // namespace btr::ui
