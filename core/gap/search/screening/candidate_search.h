#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/screening/screener.h"
#include "core/gap/search/screening/tried_candidate.h"

namespace btr {

/// All candidates beside a model, screened and, where they promise something, fitted, scored and compared with it.
struct Round {
  std::vector<TriedCandidate> tried;  ///< scored ones first, best first
  Scored without;                     ///< the model without them, with the present step
};

/// One round of a search: screening, then confirmation.
class CandidateSearch {
 public:
  /// Keeps references.
  CandidateSearch(FitService& service, Confirmer& confirmer)
      : service_(service), screener_(service), confirmer_(confirmer) {}

  struct Request {
    Scored without;
    std::vector<Fit> models;            ///< fits begin from any of them; the first is that of `without`
    const Linearised* known = nullptr;  ///< sensitivities of the first, if they are known
    std::size_t toFit = 0;
    std::string stage{};                                        ///< ends its name in the progress
    double from = 0, to = 1;                                    ///< shares of the search
    double hopeless = std::numeric_limits<double>::infinity();  ///< cost of first fits from which none is fitted on
    bool lastChance = false;   ///< all that promise anything are fitted before none is said to help
    bool beyondBest = false;   ///< where the best leaves much, others that promise about as much are fitted, too
    Eligible eligible{};       ///< what is looked at
    bool fewScreened = false;  ///< in full, after a first look at all: what may take the place of an effect
    bool shortRace = false;    ///< none is begun again in windows
  };
  /// Where something passes that needs a finer step, that step stays.
  Round search(const Request& request);

 private:
  /// What was not fitted, promises about as much as the best, and fits better than what passes and leaves much.
  std::vector<std::size_t> beyondBest(Screening& screening, const std::string& stage, double at) const;

  FitService& service_;
  Screener screener_;
  Confirmer& confirmer_;
};

}  // namespace btr
