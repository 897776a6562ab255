#pragma once
#include "core/sim/bench/bench.h"

namespace btr::bench {

/// Forty kicks of the ERS-7: the ten learned ones of `btr bench`, fifteen that a GA would make of them (every gene
/// changed by a normal of 5 % of its range) and fifteen drawn from the whole genotype, most of which miss the ball.
/// Always the same: seed 1.
BenchTask manyKicks(const Controller& kick);

/// Thirty walks of the ERS-7, 4 s each, with half_ellipse: the gait of Murcia (2007) and 29 that a GA would make of it
/// (5 % of each range). Always the same: seed 1.
BenchTask manyWalks(const Controller& halfEllipse);

}  // namespace btr::bench
