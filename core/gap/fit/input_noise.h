#pragma once
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// What drives a replay was recorded, too, and its noise is in what the replay is compared by. Where joints follow
/// their recorded motion (drive `motion`) and the torque that this takes is compared, that torque is a second
/// derivative of recorded positions: 0.05 mrad at 500 Hz on a link of 10 kg·m² are 300 N·m. Where recorded torques
/// drive them (drive `torque`; a command is exact), positions are their second integral: 0.02 N·m on a wrist of
/// 0.001 kg·m² at 500 Hz are 0.5 rad after a second. These two make the floors what they are.

/// Of recordings that went through a low-pass filter and are simulated as whole trials: filters the recorded torques
/// once more, as those of such replays are (followed_torques.h). Leaves torques within three periods of the lowest
/// cutoff from either end, at most a quarter of the trial, uncompared: a filter knows nothing of what was before the
/// first row and after the last. True if it did something, so that noise floors are to be shared anew.
bool prepareFilteredMotions(FitProblem& problem, bool whole);

/// Adds to the noise floors what the noise of recorded inputs makes of a replay: each segment is replayed with its
/// inputs as recorded and with noise like their own once more (drawn from a seed of its own), and the r.m.s. of the
/// difference over all trials counts, of positions that are followed in the torques, of torques in all that moves.
/// Says so, with what would help, where that is most of a floor. Call it when segments are cut.
void addInputNoise(FitProblem& problem);

}  // namespace btr
