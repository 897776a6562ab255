#pragma once
#include <memory>

#include "core/model/robot_model.h"

namespace btr::test {

inline Shape makeShape(Shape::Kind kind, const Eigen::Vector3d& at, const Eigen::Vector3d& size,
                       const std::array<float, 4>& colour, const std::string& part = "") {
  Shape shape;
  shape.kind = kind;
  shape.pose = Eigen::Isometry3d(Eigen::Translation3d(at));
  shape.size_m = size;
  shape.colour = colour;
  shape.part = part;
  return shape;
}

/// A white body of 0.2 × 0.1 × 0.1 m with a red or blue plate on its back, and a grey arm of 0.1 m on each of two
/// joints at its front: "pitch" turns about −y, "lift" slides along z.
inline std::shared_ptr<const RobotModel> smallRobot() {
  auto model = std::make_shared<RobotModel>();
  model->name = "small";
  model->links.resize(3);
  using Kind = Shape::Kind;
  model->links[0].name = "BODY";
  model->links[0].shapes = {makeShape(Kind::box, {0, 0, 0}, {0.2, 0.1, 0.1}, {0.95f, 0.95f, 0.95f, 1}),
                            makeShape(Kind::box, {-0.03, 0, 0.055}, {0.1, 0.1, 0.01}, {0.85f, 0.1f, 0.1f, 1}, "red"),
                            makeShape(Kind::box, {-0.03, 0, 0.055}, {0.1, 0.1, 0.01}, {0.1f, 0.2f, 0.9f, 1}, "blue")};
  for (int i : {1, 2}) {
    model->links[i].name = i == 1 ? "ARM" : "HAND";
    model->links[i].shapes = {makeShape(Kind::box, {0.05, 0, 0}, {0.1, 0.03, 0.03}, {0.5f, 0.5f, 0.5f, 1})};
  }
  model->joints.resize(2);
  model->joints[0].name = "pitch";
  model->joints[0].origin = Eigen::Isometry3d(Eigen::Translation3d(0.1, 0, 0));
  model->joints[0].axis = -Eigen::Vector3d::UnitY();
  model->joints[1].name = "lift";
  model->joints[1].type = Joint::Type::slide;
  model->joints[1].parentLink = 1;
  model->joints[1].origin = Eigen::Isometry3d(Eigen::Translation3d(0.1, 0, 0));
  model->joints[1].axis = Eigen::Vector3d::UnitZ();
  return model;
}

}  // namespace btr::test
