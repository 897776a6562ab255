#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/score.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/fit_service.h"

namespace btr {

/// What calibration made of the simulator as given.
struct Calibration {
  Scored given;             ///< nothing fitted but initial states
  Scored calibrated;        ///< never worse than that
  bool unstable = false;    ///< free runs predict blocks far worse than they fit them; what follows is not set then
  Scored base;              ///< `calibrated`, with insensitive numbers out of the fit: each costs a replay a step
  Linearised linear;        ///< of `base`
  Uncertainty uncertainty;  ///< of `calibrated`
  std::vector<FitParameter> held;  ///< numbers to which the calibrated simulator is not sensitive, as given
};

/// Fits the numbers of the scene, without any effect. Thresholds: Calibration.
class Calibrator {
 public:
  /// Keeps a reference. Leaves the service with the step that the calibrated simulator needs.
  explicit Calibrator(FitService& service) : service_(service) {}

  Calibration calibrate() const;
  /// Of the first effect: another calibration if the numbers, begun where a fit `with` the effect left them, do as well
  /// without it. Calibration may stop in a side minimum, where it is not sensitive to a number that matters elsewhere
  /// (a servo's largest torque) and holds it; an effect, whatever it is, lets the fit go on from there and earns what
  /// is the number's.
  std::optional<Calibration> recalibrate(const Calibration& before, const Scored& with) const;

 private:
  Scored fitNumbers() const;
  Scored asGiven(const std::vector<std::vector<double>>& shifts) const;
  /// Free runs near a limit of stability: a hair of a number decides where they end.
  bool isUnstable(const Scored& calibrated) const;
  void finish(Calibration& calibration) const;

  FitService& service_;
};

}  // namespace btr
