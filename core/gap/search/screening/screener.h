#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/screening/screen.h"
#include "core/gap/search/screening/tried_candidate.h"

namespace btr {

/// A model that candidates are added to.
struct FitBase {
  Fit fit;
  Linearised linear;
};

/// Where the fit of a candidate may begin.
struct FitStart {
  Screened::Start from;
  std::size_t base = 0;  ///< which of the models
  double left = 0;       ///< squared error that it promises to leave
};

/// What a candidate promises from all bases together.
struct Promise {
  bool excited = false, refused = false;
  double share = 0;              ///< of the first base's squared error
  std::vector<FitStart> starts;  ///< the best first; with whole numbers the second has another one
  std::size_t kinds = 0;         ///< so many of the first are one of each kind that a whole number can be
};

/// All candidates beside a model.
struct Screening {
  std::vector<FitBase> bases;
  std::vector<Promise> promises;      ///< by TriedCandidate::promise
  std::vector<TriedCandidate> tried;  ///< most promising first; once some are fitted, those first, best first

  const Promise& promiseOf(const TriedCandidate& each) const { return promises[each.promise]; }
};

/// From all effects at all places to the few that are worth a fit. Thresholds: Screening. `from`, `to`, `at`: shares of
/// the search, for progress; `stage` ends its name in the progress.
class Screener {
 public:
  /// Keeps a reference.
  explicit Screener(const FitService& service) : service_(service) {}

  /// Linear screening beside any of the models. `known`: sensitivities of the first at the present step, or nothing.
  Screening screenBeside(const std::vector<Fit>& models, const Eligible& eligible, const Linearised* known,
                         const SearchThresholds::Screening& limits, const std::string& stage, double from,
                         double to) const;
  /// First fits of up to `toFit` that promise most, each from its best start, the better half and what those contain
  /// from a second one, and with `inWindows` restarts in windows where much is left.
  void fitPromising(Screening& screening, std::size_t toFit, bool inWindows, const std::string& stage, double from,
                    double to) const;
  /// Screening is linear: far from the truth it may rank low what is missing. Fits others that promise at least a share
  /// of the squared error; which of `tried` are best.
  std::vector<std::size_t> fitRest(Screening& screening, double leastPromise, const std::string& stage,
                                   double at) const;
  /// Whether a candidate is a simpler form of one of those at the same place.
  bool isContained(const Screening& screening, std::size_t k, const std::vector<std::size_t>& in) const;

 private:
  /// From the best start of each kind that was not fitted yet; those of `twice` were fitted from two starts.
  void fitKinds(Screening& screening, const std::vector<std::size_t>& all, const std::vector<std::size_t>& twice,
                const std::string& stage, double at) const;
  /// Beside the other bases with their numbers held, then set free: what a calibration that went far took up shows
  /// there as it is. The best few of each; which of `tried` they are.
  std::vector<std::size_t> fitBesideHeld(Screening& screening, const std::string& stage, double at) const;
  /// Of each candidate the fit that costs least.
  void keepBetter(Screening& screening, const std::vector<std::size_t>& owner,
                  const std::vector<std::optional<Fit>>& fits) const;
  /// From start number `start` of each, where it has so many.
  void fitFrom(Screening& screening, const std::vector<std::size_t>& which, std::size_t start, const std::string& stage,
               double from, double to) const;

  const FitService& service_;
};

}  // namespace btr
