#pragma once
// Photographs of a chessboard by a camera of ours, drawn by tests.
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "core/camera/camera_pipeline.h"
#include "core/camera/stages/brown.h"
#include "core/camera/twin.h"
#include "core/spec/random.h"
#include "tests/camera/pictures.h"

namespace btr::test {

/// From the board's frame (its first inner corner, x along columns, y along rows) to the picture's (x right, y down, z
/// forward).
inline ViewPose poseOf(const Eigen::Isometry3d& place) {
  const Eigen::AngleAxisd turn(place.rotation());
  const Eigen::Vector3d axis = turn.angle() * turn.axis();
  return {{axis.x(), axis.y(), axis.z()}, {place.translation().x(), place.translation().y(), place.translation().z()}};
}

/// How bright the board is at a place of its plane; a white border of one square, grey around it.
inline float boardLight(const BoardPattern& board, double x_m, double y_m) {
  const int i = static_cast<int>(std::floor(x_m / board.square_m)),
            j = static_cast<int>(std::floor(y_m / board.square_m));
  if (i < -2 || i > board.columns || j < -2 || j > board.rows) return 0.4f;
  if (i < -1 || i >= board.columns || j < -1 || j >= board.rows) return 0.9f;
  return (i + j) % 2 == 0 ? 0.05f : 0.9f;
}

/// What a camera without errors sees, 4 × 4 rays a pixel.
inline PinholePicture boardSeen(const Pinhole& pinhole, const BoardPattern& board, const Eigen::Isometry3d& place) {
  const Eigen::Matrix3d axes = place.rotation();
  const Eigen::Vector3d origin = place.translation();
  constexpr int rays = 4;
  return drawn(pinhole, [&](int x, int y, float* rgb) {
    float sum = 0;
    for (int a = 0; a < rays; ++a)
      for (int b = 0; b < rays; ++b) {
        const double u = x + (a + 0.5) / rays - 0.5, v = y + (b + 0.5) / rays - 0.5;
        const Eigen::Vector3d ray((u - pinhole.centreX_px) / pinhole.focal_px,
                                  (v - pinhole.centreY_px) / pinhole.focal_px, 1);
        const double distance = axes.col(2).dot(origin) / axes.col(2).dot(ray);
        const Eigen::Vector3d hit = distance * ray - origin;
        sum += boardLight(board, axes.col(0).dot(hit), axes.col(1).dot(hit));
      }
    rgb[0] = rgb[1] = rgb[2] = sum / (rays * rays);
  });
}

/// Where the camera's lens puts the corners, in the order of boardView().
inline std::vector<std::array<double, 2>> trueCorners(const CameraSpec& spec, const BoardPattern& board,
                                                      const Eigen::Isometry3d& place) {
  const BrownTerms terms = brownTerms(spec);
  std::vector<std::array<double, 2>> corners;
  for (int j = 0; j < board.rows; ++j)
    for (int i = 0; i < board.columns; ++i) {
      const Eigen::Vector3d p = place * Eigen::Vector3d(i * board.square_m, j * board.square_m, 0);
      const auto seen = distorted(terms, p.x() / p.z(), p.y() / p.z());
      corners.push_back({spec.centreX_px + spec.focal_px * seen[0], spec.centreY_px + spec.focal_px * seen[1]});
    }
  return corners;
}

/// A place where the whole board is in the picture, `margin_px` from its sides.
inline Eigen::Isometry3d randomPlace(Random& random, const CameraSpec& spec, const BoardPattern& board,
                                     double margin_px) {
  for (;;) {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    const double distance = random.uniform(0.30, 0.55);
    place.translate(
        Eigen::Vector3d(random.uniform(-0.3, 0.3) * distance, random.uniform(-0.25, 0.25) * distance, distance));
    place.rotate(Eigen::AngleAxisd(random.uniform(-0.6, 0.6), Eigen::Vector3d::UnitX()));
    place.rotate(Eigen::AngleAxisd(random.uniform(-0.6, 0.6), Eigen::Vector3d::UnitY()));
    place.rotate(Eigen::AngleAxisd(random.uniform(-0.4, 0.4), Eigen::Vector3d::UnitZ()));
    place.translate(-0.5 * board.square_m * Eigen::Vector3d(board.columns - 1, board.rows - 1, 0));
    bool inside = true;
    for (const auto& corner : trueCorners(spec, board, place))
      inside = inside && corner[0] > margin_px && corner[0] < spec.width - margin_px && corner[1] > margin_px &&
               corner[1] < spec.height - margin_px;
    if (inside) return place;
  }
}

}  // namespace btr::test
