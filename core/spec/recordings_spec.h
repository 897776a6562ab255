#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

class JsonReader;

/// How a robot is recorded. Hung up by its body with the legs in the air it shows what its servos and gears do,
/// whatever the ground does, and its joints can be simulated without contacts. On the floor, as in the trial, it shows
/// everything at once.
enum class RobotPose { hungUp, onFloor };
const char* toText(RobotPose pose);  ///< "hung_up", "on_floor"
/// Throws InputError for another word; `place` begins it.
RobotPose robotPose(const std::string& word, const std::string& place);

/// The block "recordings" of an experiment: after one measurement stage the measured individuals are recorded as well,
/// gap analysis compares the recordings with the simulator, and the repaired simulator becomes its next version. With
/// all at its defaults (after_stage 0) nothing is recorded and L3 changes only parameters. Recorded in both poses,
/// each gets an analysis of its own: what the hanging pose identifies of servos and gears stays, and the floor's
/// recordings, which depend on the smallest detail, are used for the floor only.
struct RecordingsSpec {
  Values settings;  ///< recordingParameters()
  std::vector<std::string>
      calibrate;  ///< names of simulatorParameters() that the analysis may fit; empty: servo_p_nm_rad, …
  std::vector<std::string> effects;  ///< effects that it considers; empty: all that act on joints
  std::vector<std::string> joints;   ///< whose positions are compared; empty: all. In both poses: while it hangs
  /// In both poses, of the second analysis: the numbers (empty: friction, slip1_m_s_n, slip2_m_s_n), anywhere in their
  /// ranges, and the effects (empty: all that do not act on joints).
  std::vector<std::string> calibrateOnFloor = {}, effectsOnFloor = {};
  bool operator==(const RecordingsSpec&) const = default;
  bool wanted() const;                   ///< after_stage is not 0
  std::vector<RobotPose> poses() const;  ///< one or both, in the order in which they are analysed
};

/// after_stage, individuals, hung_up_individuals, robot (hung_up | on_floor | hung_up_then_on_floor), calibrate_within,
/// maximum_effects, floor_compared_s, floor_compares (everything | body_and_ball), told_numbers (anywhere |
/// within_intervals | within_intervals_alone).
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
