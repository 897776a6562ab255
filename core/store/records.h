#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/simulator_spec.h"

// Plain values that cross the border of the database. Ids are the rows' own numbers, 0 means "not stored yet / none".
// Times are UTC texts "2026-11-21T10:11:12Z".
namespace btr {

using Id = std::int64_t;

struct ExperimentRecord {
  Id id = 0;
  std::string name;
  std::string specJson;  ///< the experiment as it was opened, see toJsonText(ExperimentSpec)
  std::string createdAt;
  std::string note;
};

/// A file that a run depends on (robot models), stored by content so that a run can be replayed anywhere.
struct StoredFile {
  std::string name;  ///< as the scene names it
  std::string sha256;
  std::string content;
};

/// Bounds of one gene: with a chromosome they give a parameter (packing.h).
struct GeneBounds {
  double minimum = 0, maximum = 0;
  bool whole = false;  ///< a whole number or a choice
  bool operator==(const GeneBounds&) const = default;
};

enum class RunState { ready, learning, waiting, adapting, finished, stopped, failed };
const char* toText(RunState state);
RunState runStateFromText(const std::string& text);

struct RunRecord {
  Id id = 0;
  Id experiment = 0;
  std::uint64_t seed = 0;
  std::string specJson;
  std::string specSha256;  ///< of specJson + sceneJson + model files: the same spec and seed is the same run
  std::string sceneJson;
  std::vector<StoredFile> files;
  std::vector<GeneBounds> genes;  ///< of the controller's genotype, in its order; empty: not known
  RunState state = RunState::ready;
  int stage = 0;        ///< measurement stages completed so far
  int generation = 0;   ///< L1 generations completed
  std::string reality;  ///< who enters real fitness: "person", "stand_in" or another plugin; a stand-in is labelled
                        ///< wherever this run is shown
  std::string programVersion;
  std::string startedAt, updatedAt;
  std::string note;
  std::string message;       ///< why it failed or what it waits for
  std::string progressJson;  ///< latest RunProgress of the runner, "" if none
  bool stopRequested = false;
};

/// One generation of L1, stored in one transaction with its individuals.
struct IndividualRecord {
  Id id = 0;
  Id run = 0;
  int generation = 0;  ///< 1, 2, …
  int slot = 0;        ///< place in the population, 0, 1, …
  Id simulator = 0;
  std::string chromosome;          ///< "0101…"
  std::vector<double> parameters;  ///< in the order of the controller's genotype
  double fitness = 0;
  std::string outcome = "finished";  ///< toText(TrialResult::Outcome)
  std::string detail;
  Id sameAs = 0;  ///< not simulated: the fitness is that of this earlier individual (see sameAsSlot)
  std::uint64_t trialSeed = 0;
  std::string traceSha256;  ///< of the trial's trace, "" if it was not recorded
  int iteration = 0;        ///< 0: evolved by L1; n: a policy of the n-th iteration of L2 after this generation
};

/// The same text for two individuals that are the same: of a learner without chromosomes its parameters tell.
std::string identityOf(const IndividualRecord& individual);

/// In a generation that is not stored yet, individuals have no ids: `sameAs` of one that equals an earlier slot of the
/// same generation. Database::addGeneration puts the id in its place.
constexpr Id sameAsSlot(int slot) { return -1 - static_cast<Id>(slot); }

struct GenerationRecord {
  Id run = 0;
  int number = 0;  ///< 1, 2, …
  Id simulator = 0;
  double best = 0, mean = 0, worst = 0;
  int trials = 0, reused = 0, failed = 0;
  double seconds = 0;                     ///< wall time; informative, not part of the result
  std::string randomState, learnerState;  ///< after tell: where a resumed run goes on; kept only of the latest
  std::string finishedAt;
  std::vector<IndividualRecord> individuals;  ///< may be empty when read back, see Database
};

/// An individual that waits for, or has, real fitness.
struct MeasurementTask {
  Id run = 0;
  int stage = 0;  ///< 1, 2, …
  Id individual = 0;
  int position = 0;             ///< drawn order in which to measure, 1, 2, …
  double simulatedFitness = 0;  ///< in the simulator version of that time; hidden from the sheet while blind
  int wantedRepeats = 1;
  bool heldOut = false;  ///< not shown to L3; the gap on it is reported apart
  int iteration = 0;     ///< 0: the stage's own measurement; n: the n-th iteration of L2 in this stage
  int rank = 0;          ///< place among those chosen for the same reason, 1 first; 0: not known, or a policy of L2
  std::optional<double> disagreement = {};  ///< chosen since candidate simulators disagree: their standard deviation
  int candidates = 0;                       ///< how many these were; 0: chosen as one of the best
};

/// What real fitness may be at most, and at least with a minus sign, whoever measured it: differences and squares of
/// such values stay finite.
inline constexpr double largestFitness = 1e9;

/// One value typed in (or answered by the stand-in). Never deleted: a correction voids the old one.
struct MeasurementRecord {
  Id id = 0;
  Id run = 0;
  Id individual = 0;
  double value = 0;  ///< in the fitness plugin's unit
  bool isVoid = false;
  std::string note = {}, who = {};
  std::string source = "person";  ///< who entered it, as the run's reality
  std::string enteredAt = {};
};

/// One policy of L2 as its learner was told of it.
struct RealityPolicy {
  Id individual = 0;
  std::optional<double> fitness;  ///< mean of what was measured; none if all of it is void
  double standardError = 0;       ///< of that mean, from repeats; 0 if it was measured once or simulated
  int count = 0;                  ///< values that count; 0 if it was simulated
};

/// One finished iteration of L2, learning in reality from the best individual.
struct RealityIteration {
  Id run = 0;
  int stage = 0;
  int number = 0;                    ///< 1, 2, …
  std::vector<double> centreBefore;  ///< where the learner stood; empty for a learner without such a point
  std::vector<double> centreAfter;
  std::string randomState, learnerState;  ///< after tell; of one that is only begun: after ask
  std::string finishedAt;
  std::vector<RealityPolicy> policies;  ///< in the learner's order
};

/// One generation of L3 with its candidates.
struct AdaptationCandidate {
  std::string chromosome;
  std::vector<double> parameters;  ///< in the order of the adapted parameters
  double error = 0;                ///< the norm of real − simulated over the measured individuals
};
struct AdaptationRecord {
  Id run = 0;
  int stage = 0;
  int number = 0;  ///< 1, 2, …
  double bestError = 0, meanError = 0;
  std::string randomState, learnerState;  ///< kept only of the run's latest
  std::vector<AdaptationCandidate> candidates;
  std::string evidenceSha256;  ///< of the measured values that the errors come from; empty: stored before it was
};

/// A simulator version: never edited.
struct SimulatorRecord {
  Id id = 0;       ///< among those of runs, or among those of rigs
  Id run = 0;      ///< 0: of a rig
  Id rig = 0;      ///< a rig's version: the experiment that stands for the rig; else 0
  int number = 0;  ///< 0 is the one the run started with, or the rig's scene as given
  Id parent = 0;
  SimulatorSpec simulator;
  std::string madeBy;    ///< "start", "L3", "gap analysis", "by hand"
  std::string evidence;  ///< JSON text: from which stage, individuals, recordings
  int madeAfterGeneration = 0;
  std::string createdAt;
};

/// Mean |real − simulated| over measured individuals of a stage, before and after the update that the stage led to.
struct GapRecord {
  Id run = 0;
  int stage = 0;
  Id simulatorBefore = 0, simulatorAfter = 0;
  double before = 0, after = 0;  ///< over the individuals L3 was shown, of this stage and all earlier ones
  std::optional<double> heldOutBefore, heldOutAfter;  ///< over the held-out individuals of all stages so far
  double newBefore = 0, newAfter = 0;  ///< over this stage's own individuals: before the update they are unseen
  double standardError = 0;            ///< of `before`, from repeats; 0 if each was measured once
  int individuals = 0;                 ///< that L3 was shown
  double heldOutStandardError = 0;     ///< of the held-out gaps, from repeats
  int heldOutIndividuals = 0;
};

/// Recording of a real or stand-in robot.
struct RecordingRecord {
  Id id = 0;
  Id experiment = 0;
  Id individual = 0;
  std::string name, sha256, mappingJson, csv, source, addedAt;
};

}  // namespace btr
