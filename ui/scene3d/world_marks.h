#pragma once
#include <Eigen/Geometry>
#include <vector>

namespace btr::ui {

/// What is drawn in the world's frame at one moment.
struct WorldMarks {
  struct Contact {
    Eigen::Vector3d place_m, force_n;
  };
  std::vector<Contact> contacts;
  std::vector<std::vector<Eigen::Vector3f>> trails;  ///< each a way, oldest place first
};

}  // namespace btr::ui
