#include "tests/rival/mjcf.h"

#include <sstream>

#include "core/sim/contact/contact_builder.h"

namespace btr::rival {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr const char* stiff = "solref=\"0.005 1\"";
constexpr double stopMargin_rad = 0.0873;  ///< a joint's stop lies five degrees beyond its software limit

std::string text(const Vector3d& v) { return toText(v.x()) + " " + toText(v.y()) + " " + toText(v.z()); }
std::string pose(const Isometry3d& p) {
  const Eigen::Quaterniond q(p.linear());
  return "pos=\"" + text(p.translation()) + "\" quat=\"" + toText(q.w()) + " " + toText(q.x()) + " " + toText(q.y()) +
         " " + toText(q.z()) + "\"";
}

void writeShapes(std::ostream& out, const Link& link) {
  for (const auto& shape : link.shapes) {
    if (!shape.collides || shape.kind == Shape::Kind::mesh) continue;
    Isometry3d at = shape.pose;
    out << "<geom contype=\"1\" conaffinity=\"2\" ";
    if (shape.kind == Shape::Kind::sphere) out << "type=\"sphere\" size=\"" << toText(shape.size_m.x()) << "\" ";
    if (shape.kind == Shape::Kind::box) out << "type=\"box\" size=\"" << text(shape.size_m / 2) << "\" ";
    if (shape.kind == Shape::Kind::cylinder) {
      at.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));  // theirs lie along z, ours along y
      out << "type=\"cylinder\" size=\"" << toText(shape.size_m.x()) << " " << toText(shape.size_m.y() / 2) << "\" ";
    }
    out << pose(at) << "/>";
  }
}

class Writer {
 public:
  Writer(const Scene& scene, const MjcfOptions& options) : scene_(scene), options_(options) {}

  std::string model() {
    out_ << "<mujoco><compiler angle=\"radian\" balanceinertia=\"false\"/><option gravity=\""
         << text(scene_.gravity_m_s2) << "\" cone=\"" << (options_.ellipticCones ? "elliptic" : "pyramidal")
         << "\" impratio=\"" << toText(options_.impratio) << "\" integrator=\"" << options_.integrator
         << "\" timestep=\"" << toText(scene_.step_s) << "\"/><default><geom " << stiff << " friction=\""
         << toText(shellFriction) << " 0 0\"/></default><worldbody>";
    // Its friction is that of everything on it.
    if (scene_.floor)
      out_ << "<geom name=\"floor\" type=\"plane\" size=\"50 50 1\" contype=\"0\" conaffinity=\"1\" priority=\"1\" "
              "friction=\""
           << toText(scene_.floor->friction) << " 0 0\"/>";
    if (!scene_.robots.empty()) writeLink(0, scene_.robots[0].start);
    for (std::size_t i = 0; i < scene_.balls.size(); ++i) writeBall(scene_.balls[i], "ball" + std::to_string(i));
    out_ << "</worldbody><contact>" << pairs_.str() << "</contact></mujoco>";
    return out_.str();
  }

 private:
  void writeLink(std::size_t index, const Isometry3d& place) {
    const SceneRobot& robot = scene_.robots[0];
    const Link& link = robot.model.links[index];
    out_ << "<body name=\"" << link.name << "\" " << pose(place) << ">";
    if (index == 0 && robot.freeBase) out_ << "<freejoint name=\"base\"/>";
    if (index > 0 && robot.model.joints[index - 1].type != Joint::Type::fixed) writeJoint(robot, index - 1);
    const auto& inertia = link.inertial.inertia_kg_m2;
    out_ << "<inertial pos=\"" << text(link.inertial.centreOfMass_m) << "\" mass=\"" << toText(link.inertial.mass_kg)
         << "\" fullinertia=\"" << toText(inertia(0, 0)) << " " << toText(inertia(1, 1)) << " " << toText(inertia(2, 2))
         << " " << toText(inertia(0, 1)) << " " << toText(inertia(0, 2)) << " " << toText(inertia(1, 2)) << "\"/>";
    if (robot.collision != "none") writeShapes(out_, link);
    for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
      if (robot.model.joints[j].parentLink == static_cast<int>(index)) writeLink(j + 1, robot.model.joints[j].origin);
    out_ << "</body>";
  }

  void writeJoint(const SceneRobot& robot, std::size_t index) {
    const Joint& joint = robot.model.joints[index];
    const bool limited = joint.upper < 1e6;
    out_ << "<joint name=\"" << joint.name << "\" type=\"" << (joint.type == Joint::Type::slide ? "slide" : "hinge")
         << "\" axis=\"" << text(joint.axis) << "\" armature=\"" << toText(robot.drives[index].rotorInertia_kg_m2)
         << "\" limited=\"" << (limited ? "true" : "false") << "\"";
    if (limited)
      out_ << " range=\"" << toText(joint.lower - stopMargin_rad) << " " << toText(joint.upper + stopMargin_rad)
           << "\"";
    if (options_.dryFriction)
      out_ << " frictionloss=\"1e-9\" solimpfriction=\"0.999 0.999 0.001\" solreffriction=\""
           << toText(2 * scene_.step_s) << " 1\"";
    out_ << "/>";
  }

  /// Ball and floor are a pair of their own: a ball's resistance to rolling is not there where a leg touches it.
  void writeBall(const BallSpec& ball, const std::string& name) {
    const double inertia = ball.inertiaFactor * ball.mass_kg * ball.radius_m * ball.radius_m;
    const double gravity = scene_.gravity_m_s2.norm();
    const double rolling =
        gravity > 0 ? ball.rollingDeceleration_m_s2 * (1 + ball.inertiaFactor) * ball.radius_m / gravity : 0;
    out_ << "<body name=\"" << name << "\" pos=\"" << toText(ball.position_m[0]) << " " << toText(ball.position_m[1])
         << " " << toText(ball.position_m[2]) << "\"><freejoint/><inertial pos=\"0 0 0\" mass=\""
         << toText(ball.mass_kg) << "\" diaginertia=\"" << text(Vector3d::Constant(inertia)) << "\"/><geom name=\""
         << name << "\" type=\"sphere\" size=\"" << toText(ball.radius_m)
         << "\" contype=\"2\" conaffinity=\"0\"/></body>";
    if (!scene_.floor) return;
    const std::string friction = toText(scene_.floor->friction);
    pairs_ << "<pair geom1=\"" << name << "\" geom2=\"floor\" condim=\"6\" " << stiff << " friction=\"" << friction
           << " " << friction << " 0 " << toText(rolling) << " " << toText(rolling) << "\"/>";
  }

  const Scene& scene_;
  const MjcfOptions& options_;
  std::ostringstream out_, pairs_;
};

}  // namespace

std::string mjcf(const Scene& scene, const MjcfOptions& options) { return Writer(scene, options).model(); }

}  // namespace btr::rival
