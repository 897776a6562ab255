#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"
#include "core/spec/parameter.h"
#include "core/store/records.h"

namespace btr {

// Numbers of a simulator that recordings have identified, on their way through the versions of a run.

/// Fitted numbers as a version's evidence keeps them: {NAME: {"before", "value", "ci95": [low, high] or null}}.
nlohmann::json toEvidence(const std::vector<GapReport::Number>& numbers);

/// By name the 95 % intervals of the numbers that gap analyses calibrated, in this version and those that it comes
/// from; of several analyses the newest. What an analysis could not identify is not in it.
std::map<std::string, GapReport::Interval> identifiedNumbers(const std::vector<SimulatorRecord>& versions,
                                                             const SimulatorRecord& newest);

/// What becomes of the others where something was identified.
enum class Unidentified { free, stay };

/// The declared parameters with bounds narrowed to the identified intervals, never without `present` (values in their
/// order). With Unidentified::stay the others have no other value than that. Where nothing was identified, all are as
/// declared.
std::vector<Parameter> withinIdentified(std::vector<Parameter> declared,
                                        const std::map<std::string, GapReport::Interval>& identified,
                                        std::span<const double> present, Unidentified others = Unidentified::free);

}  // namespace btr
