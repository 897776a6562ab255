#pragma once
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// Where joints follow their recorded motion (drive `motion`) and the torque that this takes is compared, that torque
/// is a second derivative of recorded positions and has their noise in it: 0.05 mrad at 500 Hz on a link of 10 kg·m²
/// are 300 N·m. These two make the floors of such torques what they are. Recordings without prescribed motion stay as
/// they are.

/// Of recordings that went through a low-pass filter and are simulated as whole trials: filters the recorded torques
/// once more, as those of such replays are (followed_torques.h). Leaves torques within three periods of the lowest
/// cutoff from either end, at most a quarter of the trial, uncompared: a filter knows nothing of what was before the
/// first row and after the last. True if it did something, so that noise floors are to be shared anew.
bool prepareFilteredMotions(FitProblem& problem, bool whole);

/// Adds to the noise floors of torques what the noise of the positions makes of them: each segment is replayed with
/// the motion as recorded and with noise like its own once more (drawn from a seed of its own), and the r.m.s. of the
/// difference over all trials counts. Says so, with the filter that would help, where that is most of a floor. Call it
/// when segments are cut.
void addMotionNoise(FitProblem& problem);

}  // namespace btr
