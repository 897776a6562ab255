#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/live/act.h"
#include "core/live/game.h"
#include "core/sim/readings.h"
#include "core/sim/scene.h"
#include "core/spec/sha256.h"

namespace btr {

/// A session at one moment, to come back to: made and taken by Session, and a value in between. What a motion remembers
/// beside Motion::memory() is not in it, nor are cameras.
struct SessionCheckpoint {
  Game game;
  ModelSet models;                     ///< shared with the session
  std::shared_ptr<const Scene> scene;  ///< the same
  WorldMemory world, lastGood;
  std::map<std::string, double> clocks;                 ///< by robot that a plugin moves
  std::map<std::string, std::vector<double>> memories;  ///< of those motions
  std::vector<std::vector<JointInput>> inputs;
  std::map<std::string, PullAct> pulls;
  std::map<std::string, std::map<std::string, double>> held;
  std::map<std::string, Orders> orders;
  std::map<std::string, Values> lamps;
  std::map<std::string, std::vector<std::vector<double>>> senses;  ///< by robot
  RefereeState referee;
  long periods = 0;
  Sha256 hash, sinceMark;

  /// SHA-256 over the traces' rows up to here.
  std::string traceSha256() const { return Sha256(hash).finish(); }
};

}  // namespace btr
