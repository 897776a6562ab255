#pragma once

namespace btr {

/// Slower than this a joint that follows a recorded motion rests [rad/s, m/s on a slide]: a hundredth of a radian
/// within a second or so; where friction is measured, "at rest" is said of less than 0.01 to 0.05 rad/s [hand].
constexpr double restsBelow(bool slides) { return slides ? 2e-5 : 0.02; }

}  // namespace btr
