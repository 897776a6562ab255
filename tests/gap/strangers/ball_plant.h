#pragma once
// A ball in the air and on a floor by an integrator of its own: classical Runge–Kutta with steps of 0.1 ms, the instant
// of each impact by bisection. Nothing of the project's simulator is in it, so that what an analysis knows of a ball it
// cannot know from the way in which the recording was made.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/gap/recordings/recording.h"
#include "core/spec/random.h"

namespace btr::test {

struct BallPlant {
  double radius_m = 0.02, mass_kg = 0.0027;
  double inertiaFactor = 2.0 / 3.0;
  double dragNumber = 0, liftNumber = 0;  ///< F = −½ρc·πr²·|w|w;  F = ½ρπr³·l·(ω × w);  w: velocity in the air
  Eigen::Vector3d wind_m_s = Eigen::Vector3d::Zero();
  double restitution = 0.62, friction = 0.5;
};

struct PlantState {
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero(), velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin_rad_s = Eigen::Vector3d::Zero();
};

inline Eigen::Vector3d plantAcceleration(const BallPlant& ball, const PlantState& state) {
  constexpr double air_kg_m3 = 1.2, gravity_m_s2 = 9.81;
  const Eigen::Vector3d w = state.velocity_m_s - ball.wind_m_s;
  const double area = std::numbers::pi * ball.radius_m * ball.radius_m;
  return Eigen::Vector3d(0, 0, -gravity_m_s2) +
         0.5 * air_kg_m3 * area / ball.mass_kg *
             (ball.liftNumber * ball.radius_m * state.spin_rad_s.cross(w) - ball.dragNumber * w.norm() * w);
}

inline PlantState plantFlown(const BallPlant& ball, const PlantState& from, double h) {
  const auto at = [&](const Eigen::Vector3d& v) {
    PlantState there = from;
    there.velocity_m_s = v;
    return plantAcceleration(ball, there);
  };
  const Eigen::Vector3d v1 = from.velocity_m_s, a1 = at(v1);
  const Eigen::Vector3d v2 = v1 + h / 2 * a1, a2 = at(v2);
  const Eigen::Vector3d v3 = v1 + h / 2 * a2, a3 = at(v3);
  const Eigen::Vector3d v4 = v1 + h * a3, a4 = at(v4);
  PlantState to = from;
  to.place_m += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
  to.velocity_m_s += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  return to;
}

/// Newton's law of impact along z; along the floor the impulse that ends the sliding, or Coulomb's limit.
inline void plantHit(const BallPlant& ball, PlantState& state) {
  const double inertia = ball.inertiaFactor * ball.mass_kg * ball.radius_m * ball.radius_m;
  const double normal = (1 + ball.restitution) * ball.mass_kg * -state.velocity_m_s.z();
  // Of the lowest point: v + ω × (−r·z).
  const Eigen::Vector2d slide(state.velocity_m_s.x() - ball.radius_m * state.spin_rad_s.y(),
                              state.velocity_m_s.y() + ball.radius_m * state.spin_rad_s.x());
  const double ends = slide.norm() / (1 / ball.mass_kg + ball.radius_m * ball.radius_m / inertia);
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  if (slide.norm() > 0) along = -slide.normalized() * std::min(ends, ball.friction * normal);
  state.velocity_m_s += Eigen::Vector3d(along.x(), along.y(), normal) / ball.mass_kg;
  // (−r·z) × J
  state.spin_rad_s += ball.radius_m / inertia * Eigen::Vector3d(along.y(), -along.x(), 0);
}

/// One step of the world with a floor at z = 0.
inline PlantState plantStepped(const BallPlant& ball, const PlantState& from, double h) {
  const PlantState to = plantFlown(ball, from, h);
  if (to.place_m.z() >= ball.radius_m || to.velocity_m_s.z() >= 0) return to;
  double early = 0, late = h;
  for (int i = 0; i < 60; ++i) {
    const double middle = (early + late) / 2;
    (plantFlown(ball, from, middle).place_m.z() >= ball.radius_m ? early : late) = middle;
  }
  PlantState hit = plantFlown(ball, from, late);
  plantHit(ball, hit);
  return plantFlown(ball, hit, h - late);
}

/// What a camera sees of it: every `sample_s`, white noise.
inline Recording plantRecording(const BallPlant& ball, PlantState state, double length_s, double sample_s,
                                double noise_m, Random& random, const std::string& name) {
  const int steps = static_cast<int>(std::ceil(sample_s / 1e-4));
  Recording recording;
  recording.source = name;
  recording.channels = {"time_s", "ball.x_m", "ball.y_m", "ball.z_m"};
  recording.columns.resize(4);
  for (int row = 0; row * sample_s <= length_s; ++row) {
    recording.columns[0].push_back(row * sample_s);
    for (int axis = 0; axis < 3; ++axis)
      recording.columns[static_cast<std::size_t>(axis) + 1].push_back(state.place_m[axis] + noise_m * random.normal());
    for (int i = 0; i < steps; ++i) state = plantStepped(ball, state, sample_s / steps);
  }
  return recording;
}

}  // namespace btr::test
