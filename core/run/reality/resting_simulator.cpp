#include "core/run/reality/resting_simulator.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace btr {

std::optional<RestingSimulator> simulatorRestingOn(const Database& database, Id run, Id individual) {
  const std::vector<SimulatorRecord> versions = database.simulators(run);
  const auto find = [&](auto value, auto member) -> const SimulatorRecord* {
    const auto found = std::ranges::find(versions, value, member);
    return found == versions.end() ? nullptr : &*found;
  };
  std::optional<RestingSimulator> resting;
  const SimulatorRecord* version = versions.empty() ? nullptr : &versions.back();
  while (version) {
    const auto evidence = nlohmann::json::parse(version->evidence, nullptr, false);
    const SimulatorRecord* parent = find(version->parent, &SimulatorRecord::id);
    const bool reverts = evidence.is_object() && evidence.contains("reverts_to");
    const auto isIndividual = [&](const nlohmann::json& shown) { return shown == individual; };
    if (evidence.is_object() && evidence.contains("individuals") && parent &&
        std::ranges::any_of(evidence["individuals"], isIndividual))
      resting = {version->number, parent->number, evidence.value("stage", 0)};
    // A version that goes back has the values of that one, not of the one that it follows.
    version = reverts ? find(evidence["reverts_to"].get<int>(), &SimulatorRecord::number) : parent;
  }
  return resting;
}

}  // namespace btr
