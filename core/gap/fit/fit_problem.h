#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/joint_pace.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"

namespace btr {

/// One coordinate of a segment's initial state, or of a sensor, that the recording knows only so well. A fit may shift
/// it, in multiples of `unit`, at the price of (hold·multiple)². Where a trial begins, a free ball is held so loosely
/// that all of its samples say how it began, not the first few, and no wrong model is pinned there.
struct Nuisance {
  enum class What {
    jointPosition,
    jointRate,
    basePosition,
    baseVelocity,
    baseTurn,
    baseSpin,
    ballPosition,
    ballVelocity,
    ballSpin,
    rounding  ///< no state: what a sensor whose counts never change is off by, as long as they do not
  };
  What what = What::jointPosition;
  std::size_t object = 0, part = 0;  ///< robot or ball, joint or axis; of a rounding: the measured channel, 0
  double unit = 0;                   ///< its standard error by the samples around, SI
  double hold = 1;                   ///< of the prior: one over its standard deviation in units
};

/// What shifts of initial states cost: sum of (hold·shift)².
double priorCost(const std::vector<Nuisance>& nuisances, const std::vector<double>& shift);

/// A stretch of a trial that is simulated from an estimated initial state: a whole trial, or a window of it.
struct Segment {
  std::size_t trial = 0;
  std::size_t first = 0, scored = 0, last = 0;  ///< rows: simulated from `first`, compared in [scored, last)
  StartState start;
  std::vector<Nuisance> nuisances;
  bool bounces = false;  ///< a ball may fly down to the floor in it: then its spin is felt there
  /// What is compared: residual k is (simulated − recorded)/noise floor of channel[k] in row[k].
  std::vector<std::size_t> channel, row;
  std::vector<int> block;  ///< of each, for scoring
  std::vector<char> fold;  ///< of each: 0 or 1, for cross-validation
};

struct FitTrial {
  Recording recording;
  Binding binding;
  std::vector<double> noiseFloor;  ///< by measured channel [its unit], r.m.s. over all trials; 0: not compared
  bool jitters = false;            ///< what motion makes of stamps that jitter is part of the floors
  /// By measured channel and row, where stamps jitter: how well a sample is known, worse where it moves faster. Empty:
  /// all as well as the channel's floor says.
  std::vector<std::vector<double>> sampleFloor;
  std::vector<double> pause_s;      ///< by measured channel: longer between two samples is a pause; of cutSegments()
  std::size_t compared = SIZE_MAX;  ///< rows from here on are not compared: of a walk, what nobody can foretell
  std::size_t rows() const { return std::min(compared, recording.rows()); }
  bool hasSampleFloors(std::size_t channel) const {
    return channel < sampleFloor.size() && !sampleFloor[channel].empty();
  }
  /// Of one sample of a measured channel: what its residual is counted in [its unit].
  double floorAt(std::size_t channel, std::size_t row) const {
    return hasSampleFloors(channel) ? sampleFloor[channel][row] : noiseFloor[channel];
  }
};

/// Recordings made ready for fits: bound to the scene, cut into segments, blocks and folds.
struct FitProblem {
  SceneSpec scene;
  ModelSet models;
  SimulatorSpec given;
  EffectLibrary library;
  std::vector<FitTrial> trials;
  std::vector<Segment> segments;
  int blocks = 0;             ///< number of scoring blocks over all trials
  double block_s = 0.5;       ///< their length
  double window_s = 0;        ///< length of a segment; 0: whole trials run freely
  double givenStep_s = 0;     ///< the scene's own; `scene` has that of the fits
  bool impacts = false;       ///< of a tossed body: windows begin between them, where its motion tells its state
  bool walks = false;         ///< a robot with a free base and joints: free runs, compared over their first steps
  bool noisyTorques = false;  ///< those that were recorded and drive joints: of some floor, their noise is nearly all
  bool mayCoarsen = false;    ///< no contacts of a free body: a coarser step was tried
  /// Of a parameter's scale, for derivatives. Where feet land, small differences show only the landing's roughness.
  double differenceStep = 1e-2;
  /// Of the scene's step, the finest that fits go to: an eighth, as a servo in and out of saturation needs it. (Of
  /// three walks, the true simulator's error at 2, 1, 0.5 and 0.25 ms is 1.10, 1.12, 1.14
  /// and 1.16; 2.1, 1.3, 1.8, 1.4; 9.1, 8.9, 8.8 and 8.5 noise floors: feet land another way with each step, so a walk
  /// goes to half alone.)
  double finestStep = 0.126;
  /// Joints are compared with where they are so much further on: an alignment that is known (alignment.h).
  double shift_s = 0;
  std::map<std::string, JointPace> paces;  ///< of measured joints, by place
  std::vector<std::string> notes;
  int jobs = 1;  ///< worker processes for the segments of one evaluation; changes no result

  /// The scene of a trial in a simulator, its own settings over it.
  Scene sceneOf(const SimulatorSpec& simulator, std::size_t trial) const;
  std::size_t residuals() const;
  /// Simulated steps of a replay of all segments.
  double steps() const;
};

/// How much of its trials says how they began [s]; infinite: all.
double startIsFelt_s(const FitProblem& problem);

/// Binds, estimates noise floors and initial states, decides between free runs and windows (free runs where an error
/// of the initial state dies out, else windows), cuts. `window_s` > 0 asks for windows of that length. Throws
/// InputError for recordings with nothing to compare.
FitProblem makeFitProblem(const GapProblem& problem, const std::vector<Recording>& recordings,
                          const EffectLibrary& library, double window_s = -1);

}  // namespace btr
