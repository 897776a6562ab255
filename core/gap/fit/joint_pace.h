#pragma once
#include <limits>
#include <map>
#include <string>

#include "core/spec/parameter.h"

namespace btr {

struct FitProblem;

/// What a joint's drive can give, and how fast the joint moves in the recordings. It says where an effect of usual size
/// is out of all proportion: what hardly brakes an arm holds the wheel of a small motor that turns a hundred times as
/// fast.
struct JointPace {
  double torque = std::numeric_limits<double>::infinity();  ///< largest of its drive [N·m or N]; infinite: not known
  bool torqueIsFitted = false;                              ///< calibrated numbers make it another one than as given
  double rate = 0;                                          ///< r.m.s. [rad/s or m/s]; 0: not known
};

/// By "ROBOT.JOINT", of what is measured; of recordings that are bound and have noise floors.
std::map<std::string, JointPace> pacesOf(const FitProblem& problem);

/// An effect's parameter as it is tried at a place: in its usual size, but where that size alone would be ten times
/// what the drive gives at that pace, in one that comes to a tenth of it. One over a torque is a limit: it begins where
/// it changes nothing, at the drive's own unless a fit may move that, and is tried a fifth below that.
Parameter inProportion(const FitProblem& problem, const std::string& at, Parameter parameter);

}  // namespace btr
