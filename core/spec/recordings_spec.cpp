#include "core/spec/recordings_spec.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
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

const char* toText(RobotPose pose) { return pose == RobotPose::hungUp ? "hung_up" : "on_floor"; }

RobotPose robotPose(const std::string& word, const std::string& place) {
  for (const RobotPose pose : {RobotPose::hungUp, RobotPose::onFloor})
    if (word == toText(pose)) return pose;
  throw InputError(place, "\"" + word + "\"", "hung_up or on_floor");
}

bool RecordingsSpec::wanted() const { return valueOf(recordingParameters(), settings, "after_stage") > 0; }

std::vector<RobotPose> RecordingsSpec::poses() const {
  const double robot = valueOf(recordingParameters(), settings, "robot");
  if (robot == 2) return {RobotPose::hungUp, RobotPose::onFloor};
  return {robot == 1 ? RobotPose::onFloor : RobotPose::hungUp};
}

const std::vector<Parameter>& recordingParameters() {
  static const std::vector<Parameter> parameters{
      {"after_stage", "", "measurement stage whose recordings are analysed, 0 for never", 0, 1e6, 0, {}, true},
      {"individuals", "", "how many of its individuals are recorded, in the order of measuring", 1, 1000, 10, {}, true},
      {"hung_up_individuals",
       "",
       "in both poses, how many of them are hung up as well, 0 for all: all have the same servos",
       0,
       1000,
       0,
       {},
       true},
      {"robot",
       "",
       "hung up by its body, legs in the air, on the floor as in the trial, or one after the other",
       0,
       2,
       0,
       {},
       false,
       {"hung_up", "on_floor", "hung_up_then_on_floor"}},
      {"calibrate_within", "", "fitted numbers stay within this share of their value, or their range if it is 0", 0.01,
       100, 0.5},
      {"maximum_effects", "", "most effects that the analysis adds", 0, 10, 2, {}, true},
      {"floor_compared_s", "s", "how long a recording on the floor is compared, from its start", 0.1, 600, 0.8},
      {"floor_compares",
       "",
       "in both poses, what is compared on the floor: everything, or where body and ball are, as joints were heard "
       "hanging",
       0,
       1,
       0,
       {},
       false,
       {"everything", "body_and_ball"}},
      {"told_numbers",
       "",
       "where L3 may move numbers that recordings have identified: anywhere, within their 95 % intervals, or there "
       "with "
       "all others held",
       0,
       2,
       0,
       {},
       false,
       {"anywhere", "within_intervals", "within_intervals_alone"}},
  };
  return parameters;
}

RecordingsSpec recordingsFrom(JsonReader& experiment, const std::string& key) {
  RecordingsSpec recordings;
  auto reader = experiment.objectIfAny(key);
  if (!reader) return recordings;
  recordings.settings = reader->values("settings", recordingParameters());
  const auto numbers = [&](const char* list) {
    std::vector<std::string> names = distinct(*reader, list);
    for (const std::string& name : names)
      if (!find(simulatorParameters(), name))
        reader->refuse(list, "names of the simulator's parameters; \"" + name + "\" is not");
    return names;
  };
  recordings.calibrate = numbers("calibrate");
  recordings.effects = distinct(*reader, "effects");
  recordings.joints = distinct(*reader, "joints");
  recordings.calibrateOnFloor = numbers("calibrate_on_floor");
  recordings.effectsOnFloor = distinct(*reader, "effects_on_floor");
  if (recordings.poses().size() < 2)
    for (const auto& [list, names] : {std::pair{"calibrate_on_floor", recordings.calibrateOnFloor},
                                      std::pair{"effects_on_floor", recordings.effectsOnFloor}})
      if (!names.empty()) reader->refuse(list, "nothing, unless \"robot\" is hung_up_then_on_floor");
  reader->finish();
  return recordings;
}

nlohmann::json toJson(const RecordingsSpec& recordings) {
  nlohmann::json block{{"settings", toJson(recordings.settings, recordingParameters())},
                       {"calibrate", recordings.calibrate},
                       {"effects", recordings.effects},
                       {"joints", recordings.joints}};
  if (!recordings.calibrateOnFloor.empty()) block["calibrate_on_floor"] = recordings.calibrateOnFloor;
  if (!recordings.effectsOnFloor.empty()) block["effects_on_floor"] = recordings.effectsOnFloor;
  return block;
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
