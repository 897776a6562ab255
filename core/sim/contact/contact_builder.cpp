#include "core/sim/contact/contact_builder.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {
using Eigen::Vector3d;

Vector3d pointVelocity(dBodyID body, const Vector3d& point) {
  if (!body) return Vector3d::Zero();
  const dReal* p = dBodyGetPosition(body);
  const dReal* v = dBodyGetLinearVel(body);
  const dReal* w = dBodyGetAngularVel(body);
  return Vector3d(v[0], v[1], v[2]) + Vector3d(w[0], w[1], w[2]).cross(point - Vector3d(p[0], p[1], p[2]));
}

void copy(const Vector3d& from, dVector3 to) {
  to[0] = from.x();
  to[1] = from.y();
  to[2] = from.z();
  to[3] = 0;
}

// First friction direction: across the normal, as near to the wanted one as can be.
Vector3d across(const Vector3d& normal, const Vector3d& wanted) {
  Vector3d direction = wanted - normal * normal.dot(wanted);
  if (direction.squaredNorm() < 1e-12) direction = Vector3d::UnitY() - normal * normal.y();
  return direction.normalized();
}

/// How fast a sliding may turn before friction across it, which would hold its direction, is let go: about the
/// acceleration of a limb or a ball that is hit. Times the step it is a speed, so that what it leaves goes with the
/// step.
constexpr double turning_m_s2 = 100;

}  // namespace

void ContactBuilder::begin(double step, double gravity_m_s2, SlidingFriction sliding) {
  step_ = step;
  sliding_ = sliding;
  bounceAbove_ = 0.01 + 1.5 * gravity_m_s2 * step;
}

bool ContactBuilder::add(const ContactPoint& point, dBodyID first, dBodyID second, const ContactSurface& surface) {
  dContact contact{};
  copy(point.position_m, contact.geom.pos);
  copy(point.normal, contact.geom.normal);
  contact.geom.depth = std::max(0.0, point.depth_m);
  const Vector3d velocity = pointVelocity(first, point.position_m) - pointVelocity(second, point.position_m);
  const double approach = -velocity.dot(point.normal);
  const double gap = std::max(0.0, -point.depth_m);
  const bool hit = surface.restitution > 0 && approach > bounceAbove_;
  // Bodies may speed up within the step; a hit that bounces waits until the surfaces touch.
  if (gap > 0 && (hit || gap > 1.5 * step_ * approach + 1e-4)) return false;

  auto& s = contact.surface;
  s.mode = dContactApprox1 | dContactFDir1 | dContactSoftERP | dContactSoftCFM;
  s.mu = surface.friction;
  if (hit) {
    // A hit: Newton's law of impact, without softness.
    s.mode |= dContactBounce;
    s.bounce = surface.restitution / (1 + surface.bounceLoss_s_m * approach);
    s.bounce_vel = 0;
    s.soft_erp = 0;
    s.soft_cfm = 0;
  } else {
    const double denominator = step_ * surface.stiffness_n_m + surface.damping_n_s_m;
    s.soft_erp = step_ * surface.stiffness_n_m / denominator;
    s.soft_cfm = 1 / denominator;
  }
  if (gap > 0) {
    s.mode |= dContactMotionN;
    s.motionN = -gap / step_;
  }
  Vector3d wanted = Vector3d::UnitX();
  if (surface.slip1_m_s_n > 0 || surface.slip2_m_s_n > 0) {
    s.mode |= dContactSlip1 | dContactSlip2;
    // The step turns a hit's momentum into a force as large as the step is short; creep asks for that of a real hit.
    const double lasts = hit ? step_ / hitDuration_s : 1;
    s.slip1 = lasts * surface.slip1_m_s_n;
    s.slip2 = lasts * surface.slip2_m_s_n;
    wanted = surface.slip1Along;
  } else {
    const Vector3d sliding = velocity + approach * point.normal;
    if (sliding.squaredNorm() > 1e-6) {
      wanted = sliding;
      if (sliding_ == SlidingFriction::isotropic) {
        s.mode |= dContactMu2;
        const double turned = turning_m_s2 * step_;
        s.mu2 = surface.friction * turned / (turned + sliding.norm());
      }
    }
  }
  copy(across(point.normal, wanted), contact.fdir1);
  const dJointID id = dJointCreateContact(session_.world(), session_.contacts(), &contact);
  dJointAttach(id, first, second);
  if (measure_) {
    feedback_.push_back({{}, point.position_m, second == nullptr});
    dJointSetFeedback(id, &feedback_.back().forces);
  }
  return gap <= step_ * std::max(0.0, approach);
}

void ContactBuilder::clear() {
  dJointGroupEmpty(session_.contacts());
  floorForce_.setZero();
  forces_.clear();
  for (const Feedback& contact : feedback_) {
    const dReal* on = contact.forces.f1;
    const Eigen::Vector3d force(on[0], on[1], on[2]);
    if (contact.floor) floorForce_ += force;
    forces_.push_back({contact.place_m, force});
  }
  feedback_.clear();
}

}  // namespace btr
