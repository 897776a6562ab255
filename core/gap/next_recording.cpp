#include "core/gap/next_recording.h"
namespace btr {
GapReport::NextRecording designNext(const FitProblem&, const SearchResult&) { return {}; }
}  // namespace btr
