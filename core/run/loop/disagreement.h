#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run/loop/run_context.h"
#include "core/store/records.h"

// What to measure next: the individuals about which simulators disagree that explain the measurements so far about
// equally well. A measurement of such an individual tells these simulators apart; one on which they agree cannot.
namespace btr {

/// Of an adaptation's candidates those whose error is at most `ratio` times `reference`, each parameter vector once; if
/// there are none, the best one. Where they are more than `count`: the best, then always the one that lies farthest
/// from its nearest already chosen (Euclidean, each parameter in units of its range; ties: the better, then the earlier
/// one). So neighbours of the best do not fill all places.
std::vector<std::vector<double>> equallyGood(const std::vector<AdaptationCandidate>& all,
                                             std::span<const Parameter> adapted, std::size_t count, double ratio,
                                             double reference);

/// `count` vectors, each parameter uniform within ± `spread` times its range around `centre`, cut at its bounds.
std::vector<std::vector<double>> drawnAround(std::span<const Parameter> adapted, std::span<const double> centre,
                                             std::size_t count, double spread, Random& random);

/// The newest simulator and up to candidate_simulators − 1 others: of the adaptation that made it those that are about
/// equally good; where it was not made by an adaptation, drawn around it.
std::vector<SimulatorSpec> candidateSimulators(const RunContext& context, int stage);

/// How far candidate simulators disagree about one individual.
struct Disagreement {
  IndividualRecord individual;
  double deviation = 0;  ///< standard deviation (n − 1) of its simulated fitness, in the fitness' unit
  int candidates = 0;    ///< n: candidates in which its trial finished
};

/// By deviation, largest first; ties keep their order. Individuals whose own trial did not finish, or that finished in
/// fewer than two candidates, are left out. Nothing if stopped.
std::optional<std::vector<Disagreement>> disagreements(RunContext& context, const std::vector<IndividualRecord>& among,
                                                       const std::vector<SimulatorSpec>& candidates);

}  // namespace btr
