#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

class JsonReader;

/// The block "recordings" of an experiment: after one measurement stage the measured individuals are recorded as well,
/// gap analysis compares the recordings with the simulator, and the repaired simulator becomes its next version. With
/// all at its defaults (after_stage 0) nothing is recorded and L3 changes parameters alone.
struct RecordingsSpec {
  Values settings;  ///< recordingParameters()
  std::vector<std::string>
      calibrate;  ///< names of simulatorParameters() that the analysis may fit; empty: servo_p_nm_rad, …
  std::vector<std::string> effects;  ///< effects that it considers; empty: all that act on joints
  std::vector<std::string> joints;   ///< whose positions are compared; empty: all
  bool operator==(const RecordingsSpec&) const = default;
  bool wanted() const;  ///< after_stage is not 0
};

/// after_stage, individuals, robot (hung_up | on_floor), calibrate_within, maximum_effects.
const std::vector<Parameter>& recordingParameters();

/// The block as it stands in the file; what is absent keeps its default. Throws InputError.
RecordingsSpec recordingsFrom(JsonReader& experiment, const std::string& key);
nlohmann::json toJson(const RecordingsSpec& recordings);

/// What a stand-in's hidden effects are drawn from: the block "concealed" of an experiment.
struct ConcealedSpec {
  std::vector<std::string> effects;  ///< names of effects; empty: all that have a typical size
  std::vector<std::string> at;       ///< places, "ers7.RF_J3"; empty: all
  bool operator==(const ConcealedSpec&) const = default;
};
ConcealedSpec concealedFrom(JsonReader& experiment, const std::string& key);
nlohmann::json toJson(const ConcealedSpec& concealed);

}  // namespace btr
