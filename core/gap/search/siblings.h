#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/selection.h"

namespace btr {

// The same effect at several joints of one robot is one finding: bearings that rub do so at every joint, each by a
// number of its own.

/// How many findings effects are: those at joints are counted once a robot.
std::size_t findingsIn(const EffectLibrary& library, const std::vector<PlacedEffect>& effects);

/// The effects of the same finding as effect `i`, without itself, in the order of the list.
std::vector<std::size_t> siblingsOf(const EffectLibrary& library, const std::vector<PlacedEffect>& effects,
                                    std::size_t i);
/// True if an effect before it is of the same finding.
bool isSibling(const EffectLibrary& library, const std::vector<PlacedEffect>& effects, std::size_t i);

/// Effect `i` of the selected model at the other joints of its robot, too: all that promise something there in one fit,
/// without those whose size hardly differs from none, again for as long as they help by the rules that one effect has
/// to pass (what a light joint shows is seen once the heavy ones are explained). They come last in the model. Not of
/// walks: where feet land another way with every number, a dozen joints at once take too long.
void addSiblings(const FitService& service, const Confirmer& confirmer, Selection& selection, std::size_t i);

/// Where another effect has just taken the place of one, last in the model: the same for the siblings of what stood
/// there (`replaced`), all at once, if that leaves no more.
void replaceSiblings(const FitService& service, Selection& selection, const PlacedEffect& replaced);

}  // namespace btr
