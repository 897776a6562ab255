#include "core/spec/recordings_spec.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"
#include "core/spec/simulator_spec.h"

namespace btr {
namespace {

std::vector<std::string> distinct(JsonReader& reader, const std::string& key) {
  std::vector<std::string> names = reader.texts(key);
  for (auto name = names.begin(); name != names.end(); ++name)
    if (name->empty() || std::find(names.begin(), name, *name) != name)
      reader.refuse(key, "names, each once; \"" + *name + "\" is not");
  return names;
}

}  // namespace

bool RecordingsSpec::wanted() const { return valueOf(recordingParameters(), settings, "after_stage") > 0; }

const std::vector<Parameter>& recordingParameters() {
  static const std::vector<Parameter> parameters{
      {"after_stage", "", "measurement stage whose recordings are analysed, 0 for never", 0, 1e6, 0, {}, true},
      {"individuals", "", "how many of its individuals are recorded, in the order of measuring", 1, 1000, 10, {}, true},
      {"robot",
       "",
       "hung up by its body, legs in the air, or on the floor as in the trial",
       0,
       1,
       0,
       {},
       false,
       {"hung_up", "on_floor"}},
      {"calibrate_within", "", "fitted numbers stay within this share of their value, or their range if it is 0", 0.01,
       100, 0.5},
      {"maximum_effects", "", "most effects that the analysis adds", 0, 10, 2, {}, true},
  };
  return parameters;
}

RecordingsSpec recordingsFrom(JsonReader& experiment, const std::string& key) {
  RecordingsSpec recordings;
  auto reader = experiment.objectIfAny(key);
  if (!reader) return recordings;
  recordings.settings = reader->values("settings", recordingParameters());
  recordings.calibrate = distinct(*reader, "calibrate");
  for (const std::string& name : recordings.calibrate)
    if (!find(simulatorParameters(), name))
      reader->refuse("calibrate", "names of the simulator's parameters; \"" + name + "\" is not");
  recordings.effects = distinct(*reader, "effects");
  recordings.joints = distinct(*reader, "joints");
  reader->finish();
  return recordings;
}

nlohmann::json toJson(const RecordingsSpec& recordings) {
  return {{"settings", toJson(recordings.settings, recordingParameters())},
          {"calibrate", recordings.calibrate},
          {"effects", recordings.effects},
          {"joints", recordings.joints}};
}

ConcealedSpec concealedFrom(JsonReader& experiment, const std::string& key) {
  ConcealedSpec concealed;
  auto reader = experiment.objectIfAny(key);
  if (!reader) return concealed;
  concealed.effects = distinct(*reader, "effects");
  concealed.at = distinct(*reader, "at");
  reader->finish();
  return concealed;
}

nlohmann::json toJson(const ConcealedSpec& concealed) { return {{"effects", concealed.effects}, {"at", concealed.at}}; }

}  // namespace btr
