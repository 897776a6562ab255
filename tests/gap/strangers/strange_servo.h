#pragma once
// A servo with a pendulum, integrated here by Runge and Kutta's fourth-order method and written down once more, so that
// an analysis is tried on a machine that shares nothing with our engine but physics. Two inertias, motor and link, with
// a gear between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace btr::strange {

struct Plant {
  // PD on the angle of `loopAtMotor ? motor : link`, within ±maxTorque.
  double p = 6, d = 0.3, maxTorque = 3;
  double motorInertia = 2e-3;                   ///< seen at the joint [kg·m²]
  double linkInertia = 0.0201, weight = 0.981;  ///< of 0.5 kg at 0.2 m; m·g·l [N·m]
  bool loopAtMotor = false, recordedAtMotor = false;
  double play = 0;                             ///< [rad]
  double stiffness = 4000, damping = 3;        ///< of the gear, or of the flanks of its gap
  double motorFriction = 0, linkFriction = 0;  ///< dry [N·m], sign(ω) smoothed over 0.005 rad/s
  double lossPerSecond = 0, lossTime = 1e9;    ///< strength = 1 − loss·T·(1 − e^(−t/T))
  bool lossOfSupply = false;                   ///< of p and the limit, the damping stays
  double deadBand = 0;                         ///< torque that is lost [N·m]
  bool leastPulse = false;                     ///< the rest passes whole
  double integral = 0, integralClamp = 0;      ///< N·m/(rad·s), N·m
  double filterTime = 0;                       ///< first-order filter of the command [s]
  double profileSpeed = 0;                     ///< slew rate of the command [rad/s]
  double profileAcceleration = 0;              ///< with it a trapezoid of speed [rad/s²]
  double errorRate = 0;                        ///< damping of the command's rate, its change over 10 ms [N·m·s/rad]
  double bias = 0;                             ///< of the commands [rad]
  double before = 0;                           ///< time on at the first command, not recorded [s]
  double loopPeriod = 0;                       ///< torque held for so long [s]
  double spring = 0, springFrom = 0;      ///< of a stop on either side of the link [N·m/rad], from that angle [rad]
  double errorBand = 0;                   ///< largest error that is let be [rad]
  bool wholeBeyond = false;               ///< outside the band the whole error counts, not the rest
  double weightHeld = 0;                  ///< of the weight, by the servo beforehand
  double strongerUp = 0;                  ///< the gain of positive errors is 1 + this, of negative ones 1 − this
  double drift = 0;                       ///< of the recorder's own sensor [rad/s]
  double sensorScale = 0;                 ///< share by which that says too much
  double recorderOffset = 0;              ///< what that says at position 0 [rad]
  double recorderLag = 0;                 ///< time constant of its filter [s]
  bool integralWaits = false;             ///< adds up nothing while the torque is at its limit
  double sensorLag = 0;                   ///< of the link's sensor, which closes the loop and is recorded [s]
  double bristle = 0, bristleWay = 0.05;  ///< dry friction that builds up over a way [N·m], [rad]
};

struct Trial {
  std::vector<double> time, command, position;
};

/// States: motor angle and rate, link angle and rate, bend of the link's bristles over its most, what a slow sensor
/// says.
using State = std::array<double, 6>;

class Servo {
 public:
  explicit Servo(const Plant& plant) : plant_(plant) {}

  /// `command` of time, rows every `sample` s, white noise of that deviation and the rounding of `counts` per turn.
  Trial run(const std::function<double(double)>& command, double duration, double sample, double noise,
            std::mt19937_64& random) {
    constexpr double h = 2e-5;
    std::normal_distribution<double> normal(0, noise);
    State x{};
    double integral = 0, followed = command(0), speed = 0, held = 0, nextLook = 0, filtered = followed;
    x[0] = x[2] = x[5] = followed;
    const long per = std::lround(sample / h), rows = std::lround(duration / sample);
    Trial trial;
    for (long row = -std::lround(plant_.before / sample); row < rows; ++row) {
      const double at = plant_.recordedAtMotor ? x[0] : plant_.sensorLag > 0 ? x[5] : x[2];
      const double now = static_cast<double>(row) * sample;
      if (row >= 0) {
        trial.time.push_back(now);
        trial.command.push_back(command(now));
        const double said = plant_.recorderLag > 0 ? filtered : at;
        trial.position.push_back((1 + plant_.sensorScale) * said + plant_.recorderOffset + plant_.drift * now +
                                 normal(random));
      }
      for (long k = 0; k < per; ++k) {
        const double t = std::max(0.0, now + static_cast<double>(k) * h);
        const double wanted = row < 0 ? command(0) : trial.command.back();
        if (plant_.filterTime > 0)
          followed += h / plant_.filterTime * (wanted - followed);
        else if (plant_.profileAcceleration > 0)
          lead(followed, speed, wanted, h);
        else if (plant_.profileSpeed > 0)
          followed += std::clamp(wanted - followed, -plant_.profileSpeed * h, plant_.profileSpeed * h);
        else
          followed = wanted;
        const double error = followed - (plant_.loopAtMotor ? x[0] : x[2]);
        const double given = plant_.integralWaits ? torque(x, followed, integral, t) : 0;
        if (std::abs(given) < plant_.maxTorque || given * error < 0)
          integral = std::clamp(integral + plant_.integral * error * h, -plant_.integralClamp, plant_.integralClamp);
        const double rate = t > 0 && plant_.errorRate > 0 ? (wanted - command(std::max(0.0, now - 0.01))) / 0.01 : 0;
        const double added = integral + plant_.errorRate * rate;
        const auto law = [&](const State& s) { return torque(s, followed, added, t); };
        if (plant_.loopPeriod > 0 && t >= nextLook - 1e-9) {
          held = law(x);
          nextLook += plant_.loopPeriod;
        }
        const auto slope = [&](const State& s) { return change(s, plant_.loopPeriod > 0 ? held : law(s)); };
        const State a = slope(x), b = slope(plus(x, a, h / 2)), c = slope(plus(x, b, h / 2)), e = slope(plus(x, c, h));
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + e[i]);
        if (plant_.recorderLag > 0) filtered += h / plant_.recorderLag * (x[2] - filtered);
      }
    }
    return trial;
  }

 private:
  static State plus(const State& x, const State& slope, double by) {
    State sum = x;
    for (std::size_t i = 0; i < x.size(); ++i) sum[i] += by * slope[i];
    return sum;
  }
  /// As fast as it may be and still stop there, and no faster there than a step allows.
  void lead(double& followed, double& speed, double wanted, double h) const {
    const double most = plant_.profileAcceleration, left = wanted - followed;
    const double may = std::min(plant_.profileSpeed, std::sqrt(2 * most * std::abs(left)));
    speed = std::clamp(std::copysign(may, left), speed - most * h, speed + most * h);
    followed += speed * h;
    if (std::abs(wanted - followed) < most * h * h && std::abs(speed) < 4 * most * h) followed = wanted, speed = 0;
  }
  double torque(const State& x, double command, double added, double t) const {
    const std::size_t at = plant_.loopAtMotor ? 0 : 2;
    const double strength = 1 - plant_.lossPerSecond * plant_.lossTime * -std::expm1(-t / plant_.lossTime);
    double error = command - (plant_.sensorLag > 0 ? x[5] : x[at]);
    if (std::abs(error) <= plant_.errorBand)
      error = 0;
    else if (!plant_.wholeBeyond)
      error -= std::copysign(plant_.errorBand, error);
    error *= 1 + std::copysign(plant_.strongerUp, error);
    double torque = plant_.p * error + added + plant_.weightHeld * plant_.weight * std::sin(x[at]),
           most = plant_.maxTorque;
    if (plant_.lossOfSupply) torque *= strength, most *= strength;
    torque = std::clamp(torque - plant_.d * x[at + 1], -most, most);
    if (!plant_.lossOfSupply) torque *= strength;
    if (plant_.leastPulse) return std::abs(torque) < plant_.deadBand ? 0 : torque;
    return torque - std::clamp(torque, -plant_.deadBand, plant_.deadBand);
  }
  State change(const State& x, double motor) const {
    const double twist = x[0] - x[2], half = plant_.play / 2, over = twist - std::clamp(twist, -half, half);
    double gear = over == 0 && half > 0 ? 0 : plant_.stiffness * over + plant_.damping * (x[1] - x[3]);
    if (half > 0 && gear * over < 0) gear = 0;
    constexpr double smooth = 0.005;
    const double dryMotor = plant_.motorFriction * std::tanh(x[1] / smooth);
    const double dryLink = plant_.linkFriction * std::tanh(x[3] / smooth);
    const double stop = plant_.spring * (x[2] - std::clamp(x[2], -plant_.springFrom, plant_.springFrom));
    return {x[1],
            (motor - gear - dryMotor) / plant_.motorInertia,
            x[3],
            (gear - plant_.weight * std::sin(x[2]) - dryLink - stop - plant_.bristle * x[4]) / plant_.linkInertia,
            (x[3] - std::abs(x[3]) * x[4]) / plant_.bristleWay,
            plant_.sensorLag > 0 ? (x[2] - x[5]) / plant_.sensorLag : 0};
  }
  Plant plant_;
};

/// Steps, a chirp, set points at random: what people drive a servo with, in turn by trial.
inline std::function<double(double)> excitation(int trial, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto held = [](double t) { return std::floor(t / 0.01 + 1e-9) * 0.01; };
  const double size = 0.5 + 0.5 * unit(random);
  if (trial % 3 == 0) {
    const double period = 0.7 + 0.5 * unit(random);
    return [=](double t) {
      const double at = held(t);
      return at < 0.3 ? 0 : std::fmod(at - 0.3, period) < period / 2 ? size : -size;
    };
  }
  if (trial % 3 == 1) {
    const double low = 0.2 + 0.2 * unit(random), rate = 0.25 + 0.2 * unit(random);
    return [=](double t) {
      const double at = std::max(0.0, held(t) - 0.3);
      return size * std::sin(2 * M_PI * (low + rate * at / 2) * at);
    };
  }
  std::vector<double> points;
  for (int i = 0; i < 64; ++i) points.push_back(2 * size * (unit(random) - 0.5));
  points[0] = 0;
  return [=](double t) { return points[static_cast<std::size_t>(held(t) / 0.45)]; };
}

}  // namespace btr::strange
