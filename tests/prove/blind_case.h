#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/gap/proof/proof_answer.h"
#include "tests/prove/blind_world.h"
#include "tests/prove/dirt.h"

namespace btr::prove {

/// What the generator can hide.
struct Hideable {
  EffectFactory make;
  std::vector<std::string> names;  ///< of the library
};

struct CaseRequest {
  std::uint64_t seed = 1, number = 0;
  std::string engine = "ode";  ///< or "mujoco"
  std::string scene, kind;     ///< empty: drawn
  std::string dirt = "quiet";  ///< what happens to the recordings that the analysis gets (dirt.h)
  std::size_t spoiled = 0;     ///< so many of its trials, never more than a third, are not what their files say
};

/// A case, whole: a function of its request and of the library, bit for bit.
struct BlindCase {
  BlindWorld world;
  SimulatorSpec simulator;  ///< true numbers, hidden effects
  ConcealedAnswer answer;
  Dirt dirt;
  std::map<std::size_t, double> spoiled;  ///< by trial: a factor of its commands, 1: its measuring is at fault
};
BlindCase drawCase(const CaseRequest& request, const Hideable& library);

/// The kinds of case: nothing, parameters, one, two, outside.
const std::vector<std::string>& caseKinds();

/// The recordings: reality at its fine step, noise and rounding added, then what loggers do; CSV text by trial.
/// `faultless` trials only: throws std::runtime_error if reality itself failed.
std::vector<std::string> recordTrials(const BlindCase& blind, const Hideable& library);
/// The same of the trials that are kept back; those are clean.
std::vector<std::string> recordFresh(const BlindCase& blind, const Hideable& library);

/// Writes scene.json, the models and trial_1.csv … into the folder (made if absent).
void writeCase(const BlindCase& blind, const Hideable& library, const std::string& folder);
/// Writes the trials that are kept back as trial_1.csv … into the folder (made if absent).
void writeFresh(const BlindCase& blind, const Hideable& library, const std::string& folder);

}  // namespace btr::prove
