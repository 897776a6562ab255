#pragma once
// An arm of three joints that swings in a vertical plane, written down once more in the angles of its links against the
// vertical and integrated here by Runge and Kutta's fourth-order method, or as game engines do (semi-implicit Euler):
//   Σⱼ Aᵢⱼ·(cos(θᵢ − θⱼ)·θⱼ″ + sin(θᵢ − θⱼ)·θⱼ′²) + Gᵢ·sin θᵢ = τᵢ − τᵢ₊₁
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace btr::strange {

using Three = Eigen::Vector3d;

struct Arm {
  Three p{40, 30, 10}, d{2, 1.2, 0.3}, maxTorque{30, 20, 8};
  Three friction = Three::Zero();  ///< dry [N·m], sign(ω) smoothed over 0.002 rad/s
  Three viscous = Three::Zero();   ///< [N·m·s/rad]
  double load = 0;                 ///< at the tip [kg]
  double euler_s = 0;              ///< step of semi-implicit Euler; 0: Runge and Kutta in steps of 0.1 ms
};

/// Lengths, masses (each at half a length) and inertias about the masses' places.
inline const Three armLength{0.3, 0.25, 0.15}, armMass{1.2, 0.8, 0.4}, armInertia{0.01, 0.005, 0.001};

/// Of the scene: as the URDF of the same arm has it.
inline std::string armUrdf() {
  std::string text = R"(<robot name="arm"><link name="wall"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>)";
  for (int i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i + 1), parent = i == 0 ? "wall" : "link" + std::to_string(i);
    const double at = i == 0 ? 0 : -armLength[i - 1];
    const std::string inertia = std::to_string(armInertia[i]);
    text += "<joint name=\"joint" + n + "\" type=\"continuous\"><parent link=\"" + parent + "\"/><child link=\"link" +
            n + "\"/><origin xyz=\"0 0 " + std::to_string(at) + "\"/><axis xyz=\"0 -1 0\"/></joint><link name=\"link" +
            n + "\"><inertial><origin xyz=\"0 0 " + std::to_string(-armLength[i] / 2) + "\"/><mass value=\"" +
            std::to_string(armMass[i]) + "\"/><inertia ixx=\"" + inertia + "\" iyy=\"" + inertia + "\" izz=\"" +
            inertia + "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>";
  }
  return text + "</robot>";
}

using Columns = std::array<std::vector<double>, 3>;  ///< by joint

struct ArmTrial {
  std::vector<double> time;
  Columns command, position, torque;
};

class SwungArm {
 public:
  explicit SwungArm(const Arm& arm) : arm_(arm) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        double sum = i == j ? armInertia[i] : 0;
        for (int k = std::max(i, j); k < 3; ++k) sum += armMass[k] * reach(i, k) * reach(j, k);
        inertia_(i, j) = sum + arm.load * armLength[i] * armLength[j];
      }
    for (int i = 0; i < 3; ++i) {
      weight_[i] = gravity * arm.load * armLength[i];
      for (int k = i; k < 3; ++k) weight_[i] += gravity * armMass[k] * reach(i, k);
    }
  }

  /// Each joint follows two sines about its own middle; rows every `sample` s with white noise.
  ArmTrial run(double duration, double sample, double noise, std::mt19937_64& random) const {
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> normal(0, noise);
    const auto drawn = [&](double from, double to) {
      return Three::NullaryExpr([&] { return from + (to - from) * unit(random); }).eval();
    };
    const Three slow = drawn(0.3, 0.7), fast = drawn(0.9, 1.5), phase = drawn(0, 6), middle = drawn(-0.4, 0.6);
    const auto command = [&](double t) {
      const double begun = std::min(1.0, t / 0.5);
      Three c;
      for (int i = 0; i < 3; ++i)
        c[i] = middle[i] +
               begun * (0.4 * std::sin(2 * M_PI * slow[i] * t) + 0.15 * std::sin(2 * M_PI * fast[i] * t + phase[i]));
      return c;
    };
    const double h = arm_.euler_s > 0 ? arm_.euler_s : 1e-4;
    const long per = std::lround(sample / h), rows = std::lround(duration / sample);
    Three q = command(0), rate = Three::Zero(), before = Three::Zero();
    ArmTrial trial;
    for (long row = 0; row <= rows; ++row) {
      const double now = static_cast<double>(row) * sample;
      const Three held = command(now);
      trial.time.push_back(now);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto joint = static_cast<Eigen::Index>(i);
        trial.command[i].push_back(held[joint]);
        trial.position[i].push_back(q[joint] + normal(random));
      }
      Three given = Three::Zero();
      for (long k = 0; k < per; ++k) {
        const Three begun = servoTorque(q, rate, held);
        if (arm_.euler_s > 0) {
          rate += h * change(q, rate, held);
          q += h * rate;
        } else {
          rungeKutta(q, rate, held, h);
        }
        // Its mean, by trapezia: what is taken at the beginning of each step alone is p·h/2 times the rate too large.
        given += (begun + servoTorque(q, rate, held)) / 2 / static_cast<double>(per);
      }
      // What was given around the row: half of it before, half after.
      if (row == 0) before = given;
      for (std::size_t i = 0; i < 3; ++i)
        trial.torque[i].push_back((before[static_cast<Eigen::Index>(i)] + given[static_cast<Eigen::Index>(i)]) / 2);
      before = given;
    }
    return trial;
  }

 private:
  static constexpr double gravity = 9.81;
  /// From the joint that link i turns about to the mass of link k, along link i.
  static double reach(int i, int k) { return i == k ? armLength[i] / 2 : armLength[i]; }

  void rungeKutta(Three& q, Three& rate, const Three& held, double h) const {
    const Three a = change(q, rate, held), rateB = rate + h / 2 * a;
    const Three b = change(q + h / 2 * rate, rateB, held), rateC = rate + h / 2 * b;
    const Three c = change(q + h / 2 * rateB, rateC, held), rateD = rate + h * c;
    const Three e = change(q + h * rateC, rateD, held);
    q += h / 6 * (rate + 2 * rateB + 2 * rateC + rateD);
    rate += h / 6 * (a + 2 * b + 2 * c + e);
  }

  Three servoTorque(const Three& q, const Three& rate, const Three& held) const {
    return (arm_.p.cwiseProduct(held - q) - arm_.d.cwiseProduct(rate))
        .cwiseMin(arm_.maxTorque)
        .cwiseMax(-arm_.maxTorque);
  }

  Three change(const Three& q, const Three& rate, const Three& held) const {
    const Three angle(q[0], q[0] + q[1], q[0] + q[1] + q[2]);
    const Three spin(rate[0], rate[0] + rate[1], rate[0] + rate[1] + rate[2]);
    Three torque = servoTorque(q, rate, held);
    for (int i = 0; i < 3; ++i) torque[i] -= arm_.friction[i] * std::tanh(rate[i] / 0.002) + arm_.viscous[i] * rate[i];
    Eigen::Matrix3d mass;
    Three right(torque[0] - torque[1], torque[1] - torque[2], torque[2]);
    for (int i = 0; i < 3; ++i) {
      right[i] -= weight_[i] * std::sin(angle[i]);
      for (int j = 0; j < 3; ++j) {
        mass(i, j) = inertia_(i, j) * std::cos(angle[i] - angle[j]);
        right[i] -= inertia_(i, j) * std::sin(angle[i] - angle[j]) * spin[j] * spin[j];
      }
    }
    const Three turned = mass.llt().solve(right);
    return {turned[0], turned[1] - turned[0], turned[2] - turned[1]};
  }

  Arm arm_;
  Eigen::Matrix3d inertia_;
  Three weight_;
};

}  // namespace btr::strange
