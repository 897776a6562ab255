#pragma once
#include <string>
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/simulator_spec.h"

namespace btr {

/// What a blind generator hid in a case, and what it would cost to leave it out. Its text is sealed by its SHA-256
/// before the case is analysed, and opened afterwards.
struct ConcealedAnswer {
  /// Something that the scene's author does not know. `outside`: not one of the effect library.
  struct Hidden {
    PlacedEffect placed;
    bool outside = false;
    std::string alsoAt;              ///< the joint that carries the link, or the link that the joint carries
    std::vector<std::string> sizes;  ///< parameters that make it act: those with a neutral value, not at it
    /// Error in noise floors (root mean square, noise included) of the true simulator without this effect, nothing
    /// refitted.
    double costUnfitted = 1;
    /// The same after all else was refitted. Where the library has a simpler relative (Coulomb of Stribeck), that
    /// relative may be fitted in its place: the smaller of both errors counts.
    double cost = 1;
  };
  std::uint64_t seed = 0, number = 0;
  std::string engine, scene, kind;  ///< "ode"; "pendulum" …; "nothing", "parameters", "one", "two", "outside"
  std::vector<Hidden> hidden;
  Values truth;                      ///< true values of the scene's `calibrate` paths
  Values noise;                      ///< by channel: standard deviation of what was added, rounding included
  std::string dirt = "quiet";        ///< what loggers did to the recordings
  std::vector<std::string> spoiled;  ///< files of the trials that are not what their files say
  std::string salt;
};

std::string toJsonText(const ConcealedAnswer& answer);
/// Throws InputError, beginning with `place`.
ConcealedAnswer answerFromJson(const std::string& text, const std::string& place);

}  // namespace btr
