#include "core/run/setup/spec_changes.h"

#include <map>
#include <nlohmann/json.hpp>

namespace btr {
namespace {

using nlohmann::json;

const std::string absent = "not set";

/// Named members of a list keep their name as key, so that their order does not matter.
std::string keyIn(const json& list, std::size_t place) {
  const json& member = list[place];
  for (const char* name : {"name", "path", "effect"})
    if (member.is_object() && member.contains(name) && member[name].is_string()) return member[name];
  return std::to_string(place + 1);
}

bool isPlain(const json& list) {
  for (const json& member : list)
    if (member.is_structured()) return false;
  return true;
}

void flatten(const json& value, const std::string& key, SpecSettings& flat) {
  const auto below = [&](const std::string& name) {
    return key.empty() || key.ends_with(' ') ? key + name : key + '.' + name;
  };
  if (value.is_object()) {
    for (const auto& [name, member] : value.items()) flatten(member, below(name), flat);
  } else if (value.is_array() && !isPlain(value)) {
    for (std::size_t k = 0; k < value.size(); ++k) flatten(value[k], below(keyIn(value, k)), flat);
  } else {
    flat[key] = value;
  }
}

// What cannot be read is still compared, as a whole.
void add(SpecSettings& flat, const std::string& text, const std::string& under) {
  if (text.empty()) return;
  const json parsed = json::parse(text, nullptr, false);
  if (parsed.is_discarded())
    flat[under.empty() ? "specification" : under] = text;
  else
    flatten(parsed, under, flat);
}

std::map<std::string, std::string> settingTexts(const RunRecord& run) {
  std::map<std::string, std::string> all;
  // 10 and 10.0 are the same setting.
  for (const auto& [key, value] : specSettings(run))
    all[key] = value.is_number() ? toText(value.get<double>()) : value.dump();
  for (const StoredFile& file : run.files) all["file " + file.name] = "sha256 " + file.sha256.substr(0, 12);
  return all;
}

}  // namespace

SpecSettings specSettings(const RunRecord& run) {
  SpecSettings all;
  add(all, run.specJson, "");
  add(all, run.sceneJson, "scene ");
  return all;
}

std::vector<SpecChange> specChanges(const RunRecord& before, const RunRecord& after) {
  const auto a = settingTexts(before), b = settingTexts(after);
  std::vector<SpecChange> changes;
  auto keys = a;
  keys.insert(b.begin(), b.end());
  for (const auto& [key, unused] : keys) {
    const auto old = a.find(key), now = b.find(key);
    const std::string was = old == a.end() ? absent : old->second, is = now == b.end() ? absent : now->second;
    if (was != is) changes.push_back({key, was, is});
  }
  return changes;
}

std::string inWords(const std::vector<SpecChange>& changes) {
  std::string text;
  for (const SpecChange& change : changes)
    text += (text.empty() ? "" : ", ") + change.key + " (" + change.before + ", now " + change.after + ")";
  return text;
}

std::optional<RunRecord> editedRun(const Database& database, const std::string& name, const RunRecord& fresh) {
  std::optional<Id> latest, unfinished;
  for (const ExperimentRecord& experiment : database.experiments()) {
    if (experiment.name != name) continue;
    for (const RunRecord& run : database.runs(experiment.id)) {
      if (database.gridOfRun(run.id)) continue;
      if (run.specSha256 == fresh.specSha256) return std::nullopt;
      if (!latest || run.id > *latest) latest = run.id;
      if (run.state != RunState::finished && (!unfinished || run.id > *unfinished)) unfinished = run.id;
    }
  }
  if (!latest) return std::nullopt;
  return database.run(unfinished.value_or(*latest));
}

}  // namespace btr
