#include "core/gap/recordings/doctor/objection.h"

#include <algorithm>

namespace btr {

void Objection::hear(const std::string& source, const std::string& mapping, const Diagnosis& found) {
  for (const Finding& finding : found.findings)
    if (finding.certain)
      certain_.push_back({{mapping, finding.channel}, finding.refutable, source + ": " + finding.text});
  for (const std::string& channel : found.following) following_.insert({mapping, channel});
}

std::optional<std::string> Objection::text() const {
  const auto first = std::find_if(certain_.begin(), certain_.end(), [&](const Certain& each) {
    return !each.refutable || !following_.contains(each.read);
  });
  return first == certain_.end() ? std::nullopt : std::optional(first->text);
}

}  // namespace btr
