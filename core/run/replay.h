#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/sim/scene.h"
#include "core/sim/trial.h"
#include "core/store/database.h"

namespace btr {

/// A stored individual run again in the simulator version it was made with.
struct Replay {
  TrialResult result;  ///< with trace
  double fitness = 0;
  double storedFitness = 0;
  std::string sha256;        ///< of the trace now
  std::string storedSha256;  ///< of the stored trace, "" if none was stored
  /// Same bits: the fitness equal to the last bit and, where a trace hash is stored, that too.
  bool identical = false;
  /// A robot of the scene, to be drawn.
  struct Robot {
    std::string name;  ///< prefix of its channels
    std::shared_ptr<const RobotModel> model;
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();  ///< where a base without channels stays
  };
  std::vector<Robot> robots;  ///< all of the scene, in its order
};
std::vector<Replay::Robot> robotsOf(const Scene& scene);
Replay replay(const Database& database, const PluginHost& host, Id run, Id individual);

}  // namespace btr
