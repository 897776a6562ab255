#pragma once
#include "core/gap/fit/score.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/selection.h"

namespace btr {

/// Drops effects that became useless beside the others, one at a time: what is worse without them by chance, or by no
/// more than the others' laws are imperfect (model_comparison.h).
void dropRedundant(FitService& service, Selection& selection, const Scored& calibrated);
/// An effect beside a simpler form of it at the same place is one law with two names: takes the richer one alone, begun
/// anew, where it does as well.
void mergeForms(const FitService& service, Selection& selection, const Scored& calibrated);
/// Puts the simpler effects of a richer one in its place, side by side, where they have fewer numbers and do as well.
/// True: it did.
bool takeApart(const FitService& service, Selection& selection, const Scored& calibrated);

}  // namespace btr
