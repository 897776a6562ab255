#pragma once
#include <optional>

#include "core/gap/recordings/doctor/joint_series.h"

namespace btr {

/// A constant difference between measured position and command that the load does not explain.
struct EncoderOffset {
  double offset = 0, uncertainty = 0;  ///< measured − true; standard error
};
/// On a fixed base: position − command = offset − compliance·(gravity's torque), both fitted, a lag given. On a free
/// base loads are not known: only what exceeds the error at which the servo gives its largest torque. Nothing below
/// 0.05 rad (5 mm) or six standard errors.
std::optional<EncoderOffset> encoderOffset(const Scene& scene, const std::vector<JointSeries>& all,
                                           const JointSeries& series, double lag_s, double period_s);

}  // namespace btr
