#include "core/run/reality/identified_numbers.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/gap_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace btr {
namespace {

/// JSON has no infinity: an end that is nowhere is null.
double endOf(const nlohmann::json& end, double nowhere) { return end.is_number() ? end.get<double>() : nowhere; }

}  // namespace

nlohmann::json toEvidence(const std::vector<GapReport::Number>& numbers) {
  nlohmann::json all = nlohmann::json::object();
  for (const GapReport::Number& n : numbers)
    all[n.name] = {{"before", n.before},
                   {"value", n.value},
                   {"ci95", n.ci95.known() ? nlohmann::json{n.ci95.low, n.ci95.high} : nlohmann::json()}};
  return all;
}

std::map<std::string, GapReport::Interval> identifiedNumbers(const std::vector<SimulatorRecord>& versions,
                                                             const SimulatorRecord& newest) {
  std::map<std::string, GapReport::Interval> identified;
  const SimulatorRecord* version = &newest;
  while (version) {
    const auto evidence = nlohmann::json::parse(version->evidence, nullptr, false);
    if (evidence.is_object() && evidence.contains("calibrated"))
      for (const auto& [name, number] : evidence["calibrated"].items())
        if (const auto& interval = number.at("ci95"); interval.is_array())
          identified.try_emplace(
              name, GapReport::Interval{endOf(interval.at(0), -INFINITY), endOf(interval.at(1), INFINITY)});
    // A reverting version comes from the one whose values it has again, not from the one that it follows.
    const bool reverts = evidence.is_object() && evidence.contains("reverts_to");
    const auto origin = reverts
                            ? std::ranges::find(versions, evidence["reverts_to"].get<int>(), &SimulatorRecord::number)
                            : std::ranges::find(versions, version->parent, &SimulatorRecord::id);
    version = origin == versions.end() ? nullptr : &*origin;
  }
  return identified;
}

std::vector<Parameter> withinIdentified(std::vector<Parameter> declared,
                                        const std::map<std::string, GapReport::Interval>& identified,
                                        std::span<const double> present, Unidentified others) {
  const auto isIdentified = [&](const Parameter& p) { return identified.contains(p.name); };
  if (std::ranges::none_of(declared, isIdentified)) return declared;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    Parameter& p = declared[i];
    const auto found = identified.find(p.name);
    if (found != identified.end()) {
      p.minimum = std::max(p.minimum, std::min(found->second.low, present[i]));
      p.maximum = std::min(p.maximum, std::max(found->second.high, present[i]));
    } else if (others == Unidentified::stay) {
      p.minimum = p.maximum = present[i];
    }
    p.byDefault = std::clamp(p.byDefault, p.minimum, p.maximum);
  }
  return declared;
}

}  // namespace btr
