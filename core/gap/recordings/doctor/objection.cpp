#include "core/gap/recordings/doctor/objection.h"

namespace btr {

void Objection::hear(const std::string& source, const std::string& mapping, const Diagnosis& found) {
  for (const Finding& finding : found.findings)
    if (finding.certain)
      certain_.push_back({{mapping, finding.channel}, finding.refutable, source + ": " + finding.text});
  for (const std::string& channel : found.following) following_.insert({mapping, channel});
}

std::optional<std::string> Objection::text() const {
  constexpr std::size_t mostInWords = 3;
  std::set<Read> told;
  std::string words;
  for (const Certain& each : certain_) {
    if ((each.refutable && following_.contains(each.read)) || !told.insert(each.read).second) continue;
    if (told.size() <= mostInWords) words += (words.empty() ? "" : "; and ") + each.text;
  }
  if (told.size() > mostInWords) words += "; and " + std::to_string(told.size() - mostInWords) + " channels more";
  return words.empty() ? std::nullopt : std::optional(words);
}

}  // namespace btr
