#include "core/model/servo_by_load.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/model/kinematics.h"

namespace btr {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double gravity_m_s2 = 9.81, givesWay_rad = 0.02, givesWay_m = 0.001, reserve = 3, standingShare = 0.5;

/// The lowest point of a shape whose link has this pose.
double lowestOf(const Shape& shape, const Isometry3d& link) {
  const Isometry3d pose = link * shape.pose;
  const Vector3d down = pose.linear().transpose() * Vector3d::UnitZ();  // the world's z in the shape's axes
  const double along = std::abs(down.y()), across = std::sqrt(std::max(0.0, 1 - along * along));
  const Vector3d& size = shape.size_m;
  double reach = 0;
  switch (shape.kind) {
    case Shape::Kind::box:
      reach = 0.5 * down.cwiseAbs().dot(size);
      break;
    case Shape::Kind::sphere:
      reach = size.x();
      break;
    case Shape::Kind::cylinder:
      reach = 0.5 * size.y() * along + size.x() * across;
      break;
    case Shape::Kind::capsule:
      reach = 0.5 * size.y() * along + size.x();
      break;
    case Shape::Kind::mesh:
      if (shape.surface)
        for (const Eigen::Vector3f& vertex : shape.surface->vertices)
          reach = std::max(reach, -down.dot(vertex.cast<double>()));
      break;
  }
  return pose.translation().z() - reach;
}

/// What some links are to a joint's axis.
struct Load {
  double torque = 0;   ///< N·m, on a slide joint N
  double inertia = 0;  ///< kg·m², on a slide joint kg
};

class Servos {
 public:
  explicit Servos(RobotModel& model)
      : model_(model),
        poses_(forwardKinematics(model, Isometry3d::Identity(), std::vector<double>(model.joints.size(), 0.0))) {
    findLowest();
  }

  void choose() {
    int changed = 0, first = 0;
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      const Joint& joint = model_.joints[i];
      if (joint.type == Joint::Type::fixed || joint.mimic || !chooseFor(i)) continue;
      if (++changed == 1) first = joint.line;
    }
    if (changed > 0)
      model_.warnings.push_back({first, std::to_string(changed) + (changed == 1 ? " joint has" : " joints have") +
                                            " no servo in the file: gains and torque are chosen by what each carries"});
  }

 private:
  void findLowest() {
    lowest_m_.assign(model_.links.size(), std::numeric_limits<double>::infinity());
    for (std::size_t l = 0; l < model_.links.size(); ++l)
      for (const Shape& shape : model_.links[l].shapes)
        if (shape.collides) lowest_m_[l] = std::min(lowest_m_[l], lowestOf(shape, poses_[l]));
  }

  /// By link: whether joint `i` carries it.
  std::vector<char> behind(std::size_t i) const {
    std::vector<char> carried(model_.links.size(), 0);
    carried[i + 1] = 1;
    for (std::size_t j = i + 1; j < model_.joints.size(); ++j)
      carried[j + 1] = carried[static_cast<std::size_t>(model_.joints[j].parentLink)];
    return carried;
  }

  Load loadOf(std::size_t i, const std::vector<char>& carried, char which) const {
    const bool slides = model_.joints[i].type == Joint::Type::slide;
    const Isometry3d& frame = poses_[i + 1];
    const Vector3d axis = frame.linear() * model_.joints[i].axis;
    Load load;
    for (std::size_t l = 0; l < model_.links.size(); ++l) {
      const Inertial& body = model_.links[l].inertial;
      if (carried[l] != which || body.mass_kg == 0) continue;
      const double distance = axis.cross(poses_[l] * body.centreOfMass_m - frame.translation()).norm();
      load.torque += body.mass_kg * gravity_m_s2 * (slides ? 1 : distance);
      const Vector3d own = poses_[l].linear().transpose() * axis;
      load.inertia +=
          body.mass_kg * (slides ? 1 : distance * distance) + (slides ? 0 : own.dot(body.inertia_kg_m2 * own));
    }
    return load;
  }

  /// Whether the robot stands on what joint `i` carries.
  bool standsOn(const std::vector<char>& carried) const {
    constexpr double near_m = 0.02;
    double here = std::numeric_limits<double>::infinity(), all = here;
    for (std::size_t l = 0; l < carried.size(); ++l) {
      all = std::min(all, lowest_m_[l]);
      if (carried[l]) here = std::min(here, lowest_m_[l]);
    }
    return model_.freeBase && std::isfinite(here) && here <= all + near_m;
  }

  bool chooseFor(std::size_t i) {
    Joint& joint = model_.joints[i];
    ServoData& servo = joint.servo;
    if (servo.p_nm_rad && servo.maxTorque_nm) return false;
    const std::vector<char> carried = behind(i);
    Load load = loadOf(i, carried, 1);
    if (standsOn(carried)) {
      const Load front = loadOf(i, carried, 0);
      load.torque = std::max(load.torque, standingShare * front.torque);
      load.inertia = std::max(load.inertia, standingShare * front.inertia);
    }
    // Of a slide joint no small servo is known: an ERS-7's gain is one of angles.
    const bool slides = joint.type == Joint::Type::slide;
    const double small = defaultServoLimit(joint.type);
    if (!slides && !(load.torque > small)) return false;
    if (!servo.p_nm_rad) {
      servo.p_nm_rad = load.torque / (slides ? givesWay_m : givesWay_rad);
      if (!servo.d_nm_s_rad) servo.d_nm_s_rad = 2 * std::sqrt(*servo.p_nm_rad * load.inertia);
    }
    if (!servo.maxTorque_nm) servo.maxTorque_nm = std::max(small, reserve * load.torque);
    return true;
  }

  RobotModel& model_;
  std::vector<Isometry3d> poses_;
  std::vector<double> lowest_m_;  ///< by link, of what collides; infinite for nothing
};

}  // namespace

void chooseServosByLoad(RobotModel& model) {
  // Every joint asks every link; a file of more is no robot.
  constexpr std::size_t mostLinks = 1000;
  if (model.links.size() <= mostLinks) Servos(model).choose();
}

}  // namespace btr
