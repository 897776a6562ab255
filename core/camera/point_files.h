#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/camera/twin.h"

namespace btr {

/// Points and where photographs show them, of a CSV file with the columns view, x_m, y_m, z_m, u_px, v_px; views in the
/// order in which they first come. Throws InputError.
std::vector<PointView> readPoints(const std::string& path);

/// Where the camera was, by view, of a CSV file with the columns view, x_m, y_m, z_m, qw, qx, qy, qz: its optical frame
/// (x forward, y left, z up) in the frame of the points. Throws InputError.
std::map<std::string, ViewPose> readPoses(const std::string& path);

/// The view with its pose. A chessboard looks the same when its ends are exchanged: where `isBoard`, the order of its
/// corners becomes that which pose and camera agree with better.
PointView withPose(PointView view, const ViewPose& pose, const CameraSpec& thought, bool isBoard);

}  // namespace btr
