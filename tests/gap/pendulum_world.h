#pragma once
// A pendulum with a servo, integrated here and not by the engine, so that nothing but the law is the same.
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/gap/fit/gap_problem.h"
#include "core/spec/random.h"
#include "tests/gap/recorded_hinge.h"

namespace btr::test {

/// Extra torque at the hinge [N·m] of position [rad], rate [rad/s] and time [s].
using ExtraTorque = std::function<double(double, double, double)>;

/// What a trial has beside the world's law.
struct TrialWorld {
  double p = 6, d = 0.3;  ///< of its servo [N·m/rad, N·m·s/rad]
  double size_rad = 0.6;  ///< of its command
  double offset_rad = 0;  ///< of its marker
  double most_nm = 3;     ///< of its motor; the scene has 3
  double length_s = 4;
  double letGo_rad = 0;  ///< how far from there it is let go
};

/// A trial at 5 ms of rigUrdf's hinge under hingeScene()'s servo: I·q̈ = clamp(p·(c − q) − d·q̇, ±3) − m·g·l·sin q + τ,
/// fourth-order Runge–Kutta in steps of 0.1 ms, white noise of noise_rad.
inline Recording recordedPendulum(const ExtraTorque& extra, std::uint64_t number, const TrialWorld& world = {}) {
  constexpr double inertia = 0.5 * 0.2 * 0.2 + 1e-4, weight = 0.5 * 9.81 * 0.2, dt = 1e-4;
  Random random = Random::forPurpose(7, "pendulum", number);
  const double f1 = random.uniform(0.3, 0.7), f2 = random.uniform(1, 2.5), phase = random.uniform(0, 6);
  const auto command = [&](double held) {
    const double step = held > 2.5 && held < 3.3 ? 0.3 : 0;
    return held < 0.3 ? 0
                      : world.size_rad *
                            (0.8 * std::sin(2 * M_PI * f1 * (held - 0.3)) + step +
                             0.25 * (std::sin(2 * M_PI * f2 * held + phase) - std::sin(2 * M_PI * f2 * 0.3 + phase)));
  };
  Recording recording;
  recording.source = "pendulum_" + std::to_string(number) + ".csv";
  recording.sha256 = "of pendulum " + std::to_string(number);
  recording.channels = {"time_s", "rig.hinge.command_rad", "rig.hinge.position_rad"};
  recording.columns.resize(3);
  double q = 0, rate = 0;
  const auto acceleration = [&](double at, double speed, double t, double held) {
    const double drive = std::clamp(world.p * (held - at) - world.d * speed, -world.most_nm, world.most_nm);
    return (drive - weight * std::sin(at) + extra(at, speed, t)) / inertia;
  };
  // It has rested where its servo holds it.
  for (int i = 0; i < 20000; ++i) {
    rate += dt * acceleration(q, rate, 0, command(0));
    q += dt * rate;
  }
  rate = 0;
  q += world.letGo_rad;
  for (int i = 0; i < std::lround(world.length_s / dt); ++i) {
    const double t = i * dt, held = command(std::floor(t / 0.01 + 1e-6) * 0.01);
    if (i % 50 == 0) {
      recording.columns[0].push_back(t);
      recording.columns[1].push_back(held);
      recording.columns[2].push_back(q + world.offset_rad + noise_rad * random.normal());
    }
    const double a1 = acceleration(q, rate, t, held), v1 = rate;
    const double a2 = acceleration(q + dt / 2 * v1, rate + dt / 2 * a1, t + dt / 2, held), v2 = rate + dt / 2 * a1;
    const double a3 = acceleration(q + dt / 2 * v2, rate + dt / 2 * a2, t + dt / 2, held), v3 = rate + dt / 2 * a2;
    const double a4 = acceleration(q + dt * v3, rate + dt * a3, t + dt, held), v4 = rate + dt * a3;
    q += dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    rate += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return recording;
}

/// The hinge with `trials` to fit and two that no fit sees.
inline GapProblem pendulumProblem(const ExtraTorque& extra, std::uint64_t trials = 3, std::uint64_t seed = 0) {
  GapProblem problem = hingeProblem();
  for (std::uint64_t i = 0; i < trials + 2; ++i)
    (i < trials ? problem.recordings : problem.heldOut).push_back(recordedPendulum(extra, 100 * seed + i));
  return problem;
}

}  // namespace btr::test
