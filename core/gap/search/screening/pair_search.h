#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/score.h"
#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/screening/candidate_search.h"
#include "core/gap/search/screening/tried_candidate.h"
#include "core/gap/search/selection.h"

namespace btr {

/// What else there was when an effect was accepted by itself.
struct Choice {
  Scored without;                      ///< the model before
  std::string accepted;                ///< the effect, as text
  std::vector<TriedCandidate> others;  ///< candidates, best first
};

/// Two effects that explain only together what is missing. Thresholds: Screening (pair…), Confirmation.
class PairSearch {
 public:
  /// Keeps references.
  PairSearch(FitService& service, const Confirmer& confirmer, CandidateSearch& candidates)
      : service_(service), confirmer_(confirmer), candidates_(candidates) {}

  /// Beside a model, from candidates of which none passed by itself, best first: the model with both, or nothing. The
  /// step is then the one that it was scored with.
  std::optional<Scored> find(const Scored& current, const std::vector<TriedCandidate>& singles);
  /// Where an effect left much and nothing more was found beside it: two others in its place, if they do better. True
  /// if they do.
  bool replaceOne(Selection& selection, const Choice& choice);
  /// Two effects that need each other still show a little by themselves.
  bool promisesAPair(const std::vector<TriedCandidate>& tried) const;
  /// Takes a model whose last two effects are accepted together, with a rung of the ladder: `what` is done.
  static void accept(Selection& selection, const Scored& pair, const std::string& what);

 private:
  FitService& service_;
  const Confirmer& confirmer_;
  CandidateSearch& candidates_;
};

}  // namespace btr
