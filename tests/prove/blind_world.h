#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "core/sim/world.h"
#include "core/spec/random.h"

namespace btr::prove {

/// One recorded trial before it is simulated: what is put in, when, and where everything begins.
struct TrialPlan {
  double sample_s = 0.008;
  double settle_s = 0;  ///< simulated before the recording begins, inputs as in the first row
  std::size_t rows = 0;
  std::vector<std::vector<double>> commands;  ///< by row, then by joint of the first robot; empty without a robot
  std::vector<char> enabled;                  ///< by row; empty: always on
  std::vector<double> jointStart;             ///< by joint of the first robot
  BallState ball;                             ///< where the ball begins
};

/// A column that is measured.
struct MeasuredColumn {
  enum class What { position, rate, basePosition, baseOrientation, ballPosition };
  What what = What::position;
  std::size_t part = 0;  ///< joint, axis 0 … 2, or w, x, y, z as 0 … 3
  std::string name;      ///< of the recording's channel
  double noise = 0;      ///< standard deviation
  double quantum = 0;    ///< rounding step, 0 none

  double floor() const;  ///< noise and rounding together
};

/// Everything of a case but what is hidden in it and which of its numbers are wrong: the same whatever the case's kind.
struct BlindWorld {
  SceneSpec scene;                           ///< as its author believes it to be
  std::map<std::string, std::string> files;  ///< models beside the scene
  ModelSet models;                           ///< the same, read
  Values given;                              ///< of the scene's calibrate paths, as in `scene`
  std::vector<TrialPlan> trials;             ///< what an analyst gets
  std::vector<TrialPlan> fresh;              ///< in the same circumstances; what the verdict is scored on
  std::vector<MeasuredColumn> columns;
  std::vector<std::size_t> commanded;  ///< joints whose command is a column of the recording
  bool showsEnabled = false;           ///< the recording has the columns `enabled`
  double fineStep_s = 1e-4;            ///< of reality
};

/// The kinds of scene, in the order that they are drawn from.
const std::vector<std::string>& sceneKinds();  ///< pendulum, leg, carpet, flight, walk
/// Draws bodies, drives, excitation, noise and what may be calibrated. Throws InputError for an unknown kind.
BlindWorld drawWorld(const std::string& kind, Random& random);

/// log-uniform in [low, high).
double drawLog(Random& random, double low, double high);

/// How far a true number may be from the given one, as a share of it.
double mostError(const std::string& path);
/// Declares that the author of the scene does not trust a number: notes what it is given as, and draws the range of a
/// fit around that. The range holds whatever truth mostError() allows, and says nothing of where in it.
void calibrate(BlindWorld& world, Random& random, const std::string& path, double given);

/// What a sensor adds to the truth.
struct Sensor {
  double noise = 0, quantum = 0;  ///< standard deviation, rounding step (0: none)
};
/// Noise of `low` to `high`, and with the chance given a rounding of 0.3 to `coarsest` of it. One sensor in six has no
/// noise at all but rounds, as an encoder does; rounding is then as large as noise would have been.
Sensor drawSensor(Random& random, double low, double high, double roundsToo, double coarsest);
/// Noise and rounding of a column.
void addColumn(BlindWorld& world, MeasuredColumn::What what, std::size_t part, const std::string& name,
               const Sensor& sensor);

/// The last `count` trials are kept back from the analyst.
void keepBack(BlindWorld& world, std::size_t count);

// One a file.
BlindWorld drawPendulum(Random& random);
BlindWorld drawLeg(Random& random);
BlindWorld drawCarpet(Random& random);
BlindWorld drawFlight(Random& random);
BlindWorld drawWalk(Random& random);

}  // namespace btr::prove
