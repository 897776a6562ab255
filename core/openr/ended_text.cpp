#include "core/openr/ended_text.h"

namespace btr::openr {

std::string sentenceOf(const Ended& ended) {
  if (ended.object.empty() && !ended.what.empty()) return ended.what;
  const std::string who = ended.object.empty() ? "the program" : ended.object;
  const std::string in = ended.method.empty() ? "" : " in " + ended.method;
  const std::string what = ended.what.empty() ? "" : ": " + ended.what;
  switch (ended.why) {
    case Ended::Why::shutdown:
      return who + " shut the robot down" + in + what;
    case Ended::Why::crash:
      return who + " crashed" + in + what;
    case Ended::Why::endlessLoop:
      return who + " did not come back" + in + what;
    case Ended::Why::refused:
      break;
  }
  return who + " cannot go on" + in + what;
}

}  // namespace btr::openr
