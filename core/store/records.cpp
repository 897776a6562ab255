#include "core/store/records.h"

#include <array>

#include "core/spec/error.h"

namespace btr {
namespace {
constexpr std::array names{"ready", "learning", "waiting", "adapting", "finished", "stopped", "failed"};
}

const char* toText(RunState state) { return names[static_cast<std::size_t>(state)]; }

RunState runStateFromText(const std::string& text) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (text == names[i]) return static_cast<RunState>(i);
  throw InputError("run state", text, "ready, learning, waiting, adapting, finished, stopped or failed");
}

std::string identityOf(const IndividualRecord& individual) {
  if (!individual.chromosome.empty()) return individual.chromosome;
  std::string text;
  for (const double value : individual.parameters) text += toText(value) + ' ';
  return text;
}

}  // namespace btr
