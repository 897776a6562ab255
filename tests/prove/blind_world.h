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

/// Everything of a case but what is hidden in it.
struct BlindWorld {
  SceneSpec scene;                           ///< as its author believes it to be, true numbers still in place
  std::map<std::string, std::string> files;  ///< models beside the scene
  ModelSet models;                           ///< the same, read
  Values truth;                              ///< of the scene's calibrate paths
  std::vector<TrialPlan> trials;
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

/// Declares that the author of the scene does not trust a number: notes its true value, and the range of a fit.
void calibrate(BlindWorld& world, const std::string& path, double trueValue);
/// Noise and rounding of a column.
void addColumn(BlindWorld& world, MeasuredColumn::What what, std::size_t part, const std::string& name, double noise,
               double quantum);

// One a file.
BlindWorld drawPendulum(Random& random);
BlindWorld drawLeg(Random& random);
BlindWorld drawCarpet(Random& random);
BlindWorld drawFlight(Random& random);
BlindWorld drawWalk(Random& random);

}  // namespace btr::prove
