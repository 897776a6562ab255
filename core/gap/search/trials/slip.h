#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// A place that from some moment on is measured wrongly, as when a marker slips or comes loose.
struct Slip {
  std::string channel;
  bool drifts = false;  ///< grows from then on until the end; else it jumps
  double from_s = 0;    ///< the recording's time
  double by = 0;        ///< at the end [the channel's unit]
  double error = 0;     ///< mean squared error of the trial without it [noise floors²]
};

/// Measured places of joints, bodies and balls.
bool isPlace(Binding::Measured::What what);

/// The slip of one position channel that makes the simulator fit a trial best, the trial's initial states fitted beside
/// it: linear least squares over all rows at which it may begin, a few times over, each where the last one led. Nothing
/// where none makes it better. `ready` makes a fit problem of recordings.
std::optional<Slip> findSlip(const Recording& recording, const FitModel& model, int iterations,
                             const std::function<FitProblem(const std::vector<Recording>&)>& ready);

/// "its ball.z_m jumps up by 0.021 m at 0.35 s, as a marker that slips does".
std::string inWords(const Slip& slip);

}  // namespace btr
