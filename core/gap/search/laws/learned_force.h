#pragma once
#include <memory>
#include <string>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/analysis.h"

namespace btr {

/// A force without a name: piecewise linear over one variable, by its values at equally spaced knots.
struct LearnedForce {
  enum class Over { position, velocity, load, time };  ///< load: the drive's torque in the last step
  enum class Along { joint, motion, x, y };            ///< at a joint; at a ball along its motion or the floor's axes
  Over over = Over::position;
  Along along = Along::joint;
  double low = 0, high = 1;  ///< of the variable; outside it the ends' values hold
  double scale = 1;          ///< a typical force [N·m or N]
  static constexpr int knots = 9;

  /// The name under which a library that knows it makes the effect; parameters are force_0 … force_8.
  std::string name() const;
  double knot(int index) const { return low + (high - low) * index / (knots - 1); }
};

/// The library and this force.
EffectLibrary withLearnedForce(const EffectLibrary& library, const LearnedForce& force);

const char* toText(LearnedForce::Over over);

}  // namespace btr
