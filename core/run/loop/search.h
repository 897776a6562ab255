#pragma once
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/setup/evaluator.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/store/database.h"

namespace btr {

/// L1 of one run in one simulator version, generation by generation, wherever it is evaluated and whatever the learner
/// is told: begins or goes on from what the database has, then repeat
///   jobs = ask();  replies = evaluate(jobs);  generation = tell(replies …);  store it;  remember(generation)
/// Vectors that were simulated in this version before are not simulated again. `prepared` must outlive it.
class Search {
 public:
  Search(const Database& database, const PluginHost& host, const PreparedExperiment& prepared, const RunRecord& run,
         const SimulatorRecord& simulator);

  int generation() const { return number_; }  ///< stored ones
  /// Begins afresh around a vector, with chance of its own.
  void beginAgain(std::span<const double> at, const Permutations& permutations, Random& random);

  /// What has to be simulated for the next generation.
  std::vector<TrialJob> ask();
  /// The next generation from the replies to ask(), without states.
  GenerationRecord fill(const std::vector<TrialReply>& replies) const;
  /// Tells the learner what each of the generation's individuals is worth, and puts the states into the record.
  void tell(GenerationRecord& generation, std::span<const double> fitness);
  /// Once it is stored (its ids are known).
  void remember(const GenerationRecord& generation);

 private:
  /// What is known of a parameter vector in this simulator.
  struct Known {
    double fitness;
    std::string outcome, detail, traceSha256;
    Id id;
  };

  const PreparedExperiment& prepared_;
  Id run_;
  SimulatorRecord simulator_;
  std::uint64_t trialSeed_;
  std::unique_ptr<Learner> learner_;
  Random random_;
  int number_ = 0;
  std::map<std::vector<double>, Known> known_;
  std::vector<Candidate> candidates_;  ///< of the generation that was asked for
  std::map<std::vector<double>, std::size_t> jobOf_;
};

/// The one seed of all trials of a run.
std::uint64_t trialSeedOf(const RunRecord& run);

}  // namespace btr
