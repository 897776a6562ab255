#include "core/gap/remainder.h"
namespace btr {
GapReport::Remainder findRemainder(const FitProblem&, const SearchResult&, int) { return {}; }
}  // namespace btr
