#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/store/database.h"

namespace btr {

/// Every setting of a run's specification and scene by its key: a number, a text, true or false, or a list of such.
using SpecSettings = std::map<std::string, nlohmann::json>;
SpecSettings specSettings(const RunRecord& run);

/// One setting that two runs do not have in common.
struct SpecChange {
  std::string key;            ///< "learner.settings.population", "scene gravity_m_s2", "file ../robots/ers7.wrl"
  std::string before, after;  ///< as text; "not set" where one of them does not have it
};

/// Every setting of specification, scene and robot files in which the runs differ, by key; seeds of the runs aside.
std::vector<SpecChange> specChanges(const RunRecord& before, const RunRecord& after);

/// "learner.settings.population (10, now 12), seed (1, now 2)".
std::string inWords(const std::vector<SpecChange>& changes);

/// The run that `fresh`, which is not stored yet, was probably meant to go on with: the latest of the experiments of
/// this name that is not finished, else the latest. None where no run has the name, or where one with the
/// specification of `fresh` is stored, so that it was begun knowingly.
std::optional<RunRecord> editedRun(const Database& database, const std::string& name, const RunRecord& fresh);

}  // namespace btr
