#pragma once
#include <vector>

#include "core/spec/random.h"

namespace btr::prove {

/// Shapes a command over a trial, about `rest`, with amplitude `size` [rad]: a multi-sine, steps, a chirp, holds with
/// ramps between, or slow triangles. The first `still_s` seconds rest. Joints that are driven together get different
/// ones.
std::vector<double> drawCommand(Random& random, std::size_t rows, double sample_s, double rest, double size,
                                double still_s = 0.25);

/// One if the drive is on: off in one or two stretches of 0.4 to 1.2 s.
std::vector<char> drawPower(Random& random, std::size_t rows, double sample_s);

}  // namespace btr::prove
