#pragma once
#include <string>
#include <vector>

#include "core/gap/proof/proof_answer.h"
#include "tests/prove/blind_world.h"

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
};

/// A case, whole: a function of its request and of the library, bit for bit.
struct BlindCase {
  BlindWorld world;
  SimulatorSpec simulator;  ///< true numbers, hidden effects
  ConcealedAnswer answer;
};
BlindCase drawCase(const CaseRequest& request, const Hideable& library);

/// The kinds of case: nothing, parameters, one, two, outside.
const std::vector<std::string>& caseKinds();

/// The recordings: reality at its fine step, noise and rounding added; CSV text by trial. `faultless` trials only:
/// throws std::runtime_error if reality itself failed.
std::vector<std::string> recordTrials(const BlindCase& blind, const Hideable& library);
/// The same of the trials that are kept back.
std::vector<std::string> recordFresh(const BlindCase& blind, const Hideable& library);

/// Writes scene.json, the models and trial_1.csv … into the folder (made if absent).
void writeCase(const BlindCase& blind, const Hideable& library, const std::string& folder);
/// Writes the trials that are kept back as trial_1.csv … into the folder (made if absent).
void writeFresh(const BlindCase& blind, const Hideable& library, const std::string& folder);

}  // namespace btr::prove
