#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/gap/fit/score.h"
#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/rivals/rival_handover.h"
#include "core/gap/search/screening/candidate_search.h"
#include "core/gap/search/screening/tried_candidate.h"
#include "core/gap/search/selection.h"

namespace btr {

/// The final model, after another effect may have taken an effect's place, and what stands beside each of its effects.
struct RivalSearch {
  Selection selection;
  std::vector<Found> effects;  ///< by effect of the final model
};

/// What would explain the recordings as well. Thresholds: Rivals.
class RivalFinder {
 public:
  /// Keeps references. `first`: what the first round tried beside the calibrated simulator.
  RivalFinder(FitService& service, Confirmer& confirmer, CandidateSearch& candidates, const Scored& calibrated,
              const std::vector<TriedCandidate>& first)
      : service_(service),
        confirmer_(confirmer),
        candidates_(candidates),
        handover_(service),
        calibrated_(calibrated),
        first_(first) {}

  /// Rivals of each effect beside the others, the last found first: it is the least sure. The same effect at other
  /// joints comes after the one that was found first, as it is asked for less. Where one is replaced, all are asked
  /// beside what stands there now.
  RivalSearch find(Selection selection);

 private:
  /// Other effects in the place of one of the final model's, beside the same others.
  struct Offered {
    Scored without;  ///< with the place empty
    std::vector<TriedCandidate> others;
  };
  /// What was offered the place of effect `i`: looked for once, and offered again to whatever has taken the place
  /// since.
  Offered& offeredTo(std::size_t i, const Scored& final, const Eligible& eligible);
  Offered inPlaceOf(std::size_t i, const Scored& final, const Eligible& eligible);
  /// All, but for an effect that stands at another joint, too, which was asked before (`found`): what is a rival there
  /// and, where something is left that a better law may take, richer and simpler forms of it, at its own joint.
  Eligible eligibleFor(std::size_t i, const Scored& final, const std::vector<std::optional<Found>>& found) const;
  /// The effects of a model in the order in which they are asked for.
  std::vector<std::size_t> inOrder(const FitModel& model) const;
  void add(const HandedOver& arrived, std::vector<TriedCandidate>& others) const;
  /// What comes near the final model is fitted as far as that was and scored with the same step, the finest that any of
  /// them needed.
  void compareAtOneStep(Selection& selection, std::vector<TriedCandidate>& others);
  /// True if a richer effect than `simpler` shows nothing beyond that: it does not take its place.
  bool isHollow(const TriedCandidate& other, const PlacedEffect& simpler) const;
  /// True if a simpler effect is all that the final model's effect `i`, which contains it, shows, and leaves hardly
  /// more, whatever a paired test makes of that little.
  bool isAllThatShows(const TriedCandidate& simpler, const Scored& final, std::size_t i) const;
  /// True if another effect took the place of effect `i`: the simpler of equals, or simply a better one.
  bool replace(std::size_t i, const std::vector<TriedCandidate>& others, Selection& selection) const;
  /// The final model's effect `i` with its rivals; attempts that turn out to be one say so.
  Found foundAt(std::size_t i, const Offered& offered, Selection& selection) const;
  /// Adds simpler effects that together say the same in the place of the final model's effect `i`.
  void addTogether(std::size_t i, const Scored& final, const std::vector<TriedCandidate>& others, Found& found) const;

  FitService& service_;
  Confirmer& confirmer_;
  CandidateSearch& candidates_;
  RivalHandover handover_;
  const Scored& calibrated_;
  const std::vector<TriedCandidate>& first_;
  std::map<std::set<std::string>, Offered> known_;  ///< by what stands beside the place, as text
};

}  // namespace btr
