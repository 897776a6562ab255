#include "core/camera/point_files.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/camera/calibration/lens_fit.h"
#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

/// Calls `row(view, numbers)` for each row of a table with the columns "view" and `columns`, in any order.
template <class Row>
void readViewTable(const std::string& path, const std::vector<std::string>& columns, const Row& row) {
  std::istringstream stream(readFile(path));
  CsvReader reader(stream, path);
  std::vector<std::string> fields;
  if (!reader.next(fields)) throw InputError(path + ": is empty");
  const auto placeOf = [&](const std::string& column) {
    const auto found = std::find(fields.begin(), fields.end(), column);
    if (found == fields.end()) throw InputError(reader.at() + ": has no column " + column);
    return static_cast<std::size_t>(found - fields.begin());
  };
  const std::size_t view = placeOf("view"), count = fields.size();
  std::vector<std::size_t> places;
  for (const std::string& column : columns) places.push_back(placeOf(column));
  while (reader.next(fields)) {
    if (fields.size() != count)
      throw InputError(reader.at(), std::to_string(fields.size()) + " fields", std::to_string(count));
    std::vector<double> numbers;
    for (const std::size_t place : places) {
      const auto number = toNumber(fields[place]);
      if (!number) throw InputError(reader.at(place + 1), "\"" + fields[place] + "\"", "a number");
      numbers.push_back(*number);
    }
    row(fields[view], numbers, reader.at());
  }
}

// The optical frame's axes are those of the picture in another order: right is −left, down is −up.
ViewPose poseOfPicture(const Eigen::Vector3d& camera, const Eigen::Quaterniond& orientation) {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Matrix3d turn = axes * orientation.toRotationMatrix().transpose();
  const Eigen::AngleAxisd angle(turn);
  const Eigen::Vector3d rotation = angle.angle() * angle.axis(), translation = -(turn * camera);
  return {{rotation.x(), rotation.y(), rotation.z()}, {translation.x(), translation.y(), translation.z()}};
}

}  // namespace

std::vector<PointView> readPoints(const std::string& path) {
  std::vector<PointView> views;
  readViewTable(path, {"x_m", "y_m", "z_m", "u_px", "v_px"},
                [&](const std::string& name, const std::vector<double>& n, const std::string&) {
                  auto view = std::find_if(views.begin(), views.end(), [&](const auto& v) { return v.name == name; });
                  if (view == views.end()) view = views.insert(view, PointView{name, {}, {}, {}});
                  view->points_m.push_back({n[0], n[1], n[2]});
                  view->seen_px.push_back({n[3], n[4]});
                });
  return views;
}

std::map<std::string, ViewPose> readPoses(const std::string& path) {
  std::map<std::string, ViewPose> poses;
  readViewTable(path, {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"},
                [&](const std::string& name, const std::vector<double>& n, const std::string& place) {
                  const Eigen::Quaterniond orientation(n[3], n[4], n[5], n[6]);
                  if (!(std::abs(orientation.norm() - 1) < 0.01))
                    throw InputError(place, "a quaternion of length " + toText(orientation.norm()),
                                     "a unit quaternion");
                  if (!poses.emplace(name, poseOfPicture({n[0], n[1], n[2]}, orientation.normalized())).second)
                    throw InputError(place, "\"" + name + "\"", "each view once");
                });
  return poses;
}

PointView withPose(PointView view, const ViewPose& pose, const CameraSpec& thought, bool isBoard) {
  view.pose = pose;
  if (!isBoard) return view;
  PointView turned = view;
  std::reverse(turned.seen_px.begin(), turned.seen_px.end());
  const LensNumbers lens{thought.focal_px, thought.centreX_px, thought.centreY_px, 0, 0, 0, 0, 0};
  return lensError(turned, lens) < lensError(view, lens) ? turned : view;
}

}  // namespace btr
