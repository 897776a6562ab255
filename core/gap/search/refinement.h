#pragma once
#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/selection.h"

namespace btr {

/// Fits the details of the final model's laws (Parameter::refines) where they predict better: those of an effect, or of
/// a simpler form in the place of a richer one that was only named for the lack of them. Thresholds: Refinement.
void refineLaws(const FitService& service, Confirmer& confirmer, Selection& selection);

}  // namespace btr
