/// A servo whose firmware computes its torque only every T seconds and holds it in between (zero-order hold).
///   τ' = (1 − s)·u(t) + s·u(k·T) for k·T ≤ t < (k + 1)·T,  k = 0, 1, …
/// u: what the law asks for, t: time of the trial, s: share of it that is computed so, 1 for all of it. On average the
/// torque is T/2 old, which takes p·T/2 of the damping away. A period that divides that of the commands meets them at
/// once, another one, however near, does not: T is a whole number of milliseconds, as firmware has it. (Franklin,
/// Powell and Workman 1998, Digital Control of Dynamic Systems, ch. 4 and 6.) Back-EMF is no firmware: with
/// `damping_stays` 1 the damping acts at once. Drives that follow a position only. Neutral: s = 0.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

/// What is remembered between two steps.
struct Loop {
  double& started;
  double& until;  ///< when what was held last ends
  double& next;   ///< number of the next sample
  double& held;   ///< the torque of the last one
  double& asked;
  double& at;  ///< when the law asked for that
  double& command;
  double& slope;  ///< of what it asks for, while its command stays
  double& rate;
  double& change;  ///< of the rate over a step
  explicit Loop(std::span<double> s)
      : started(s[0]),
        until(s[1]),
        next(s[2]),
        held(s[3]),
        asked(s[4]),
        at(s[5]),
        command(s[6]),
        slope(s[7]),
        rate(s[8]),
        change(s[9]) {}

  void see(double now, double time, double followed) {
    if (started != 0 && followed == command && time > at) slope = (now - asked) / (time - at);
    asked = now;
    at = time;
    command = followed;
  }
  /// A step knows the rate of half a step ago: what damping takes since.
  double lostSince(const btr::JointState& joint) {
    if (joint.rate != rate) change = started != 0 ? joint.rate - rate : 0;
    rate = joint.rate;
    return joint.damping * change / 2;
  }
  /// Mean of what is held over the next `length` seconds.
  double mean(double period, double length) {
    // What comes at the instant of a sample is seen by it.
    const double close = 1e-6 * length, end = until + length;
    double sum = 0, since = until;
    for (; next * period < end - close; next += 1) {
      const double sample = std::max(until, next * period);
      sum += held * (sample - since);
      held = asked + slope * (sample - at);
      since = sample;
    }
    sum += held * (end - since);
    until = end;
    return sum / length;
  }
};

class SampledLoop final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter period{"period_ms", "ms", "time for which a torque is held", 1, 40, 10};
    period.integer = true;
    return {{"share", "", "of the law that is computed so", 0, 1, 1, 0.0}, period, btr::dampingStaysParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that computes its torque only now and then and holds it in between",
            "τ’ = (1 − s)·u(t) + s·u(k·T),  k·T ≤ t < (k + 1)·T",
            "s: share; T: period_ms; u: what the law asks for; t: time of the trial",
            "Franklin, Powell and Workman 1998"};
  }
  Place place() const override { return Place::joint; }
  /// Part of the servo's law, the last of it by its name.
  Stage stage() const override { return Stage::command; }
  int stateSize() const override { return 10; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values,
                     std::span<double> state, double dt) const override {
    const double share = values[0], period = 1e-3 * values[1];
    if (share == 0 || !joint.followsPosition || dt <= 0) return torque;
    const double atOnce = values[2] != 0 ? -joint.damping * joint.rate : 0;
    const double asked = torque + joint.beyond - atOnce;
    Loop loop(state);
    double held = loop.held;
    if (!joint.isTry) {
      const double seen = asked - (values[2] != 0 ? 0 : loop.lostSince(joint));
      loop.see(seen, joint.time, joint.command);
      if (loop.started == 0) {
        loop.started = 1;
        loop.held = seen;
        loop.until = joint.time - dt / 2;
        loop.next = std::ceil((loop.until - 1e-6 * dt) / period);
      }
      held = loop.mean(period, dt);
    }
    return btr::withinLimits((1 - share) * asked + share * held + atOnce, torque, joint);
  }
};

}  // namespace

BTR_EFFECT(SampledLoop, "sampled_loop")
