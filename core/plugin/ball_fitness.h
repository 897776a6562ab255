#pragma once
#include "core/sim/fitness.h"

namespace btr {

/// A fitness that may depend on nothing of a trial but where its balls come to rest. Where the value alone is wanted
/// (L3 compares values), robots are then no longer simulated once no ball can be reached any more.
class BallFitness : public Fitness {
 public:
  /// True if, with these settings, evaluate() reads no more of a trial that finished than `balls`.
  virtual bool seesBallsOnly(const Values& settings) const = 0;
};

}  // namespace btr
