#include "core/run/bench/large_database.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/run/loop/back_to_reality.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/spec/random.h"
#include "core/store/database.h"
#include "core/store/packing.h"

namespace btr {
namespace {

constexpr int bitsOfAGene = 8;
constexpr std::size_t learnerState_bytes = 6700;  // of the genetic algorithm after 100 generations of kicks
constexpr double mutation = 0.015;

std::string hexadecimal(Random& random, std::size_t length) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(length, '0');
  for (char& letter : text) letter = digits[random.below(16)];
  return text;
}

std::string bytes(Random& random, int count) {
  std::string text(static_cast<std::size_t>(count), '\0');
  for (char& byte : text) byte = static_cast<char>(random.below(256));
  return text;
}

std::string detailOfAKick(Random& random, double way_m) {
  char text[128];
  std::snprintf(text, sizeof text, "falls 0, largest_tilt_rad %.4g, off_direction_rad %.4g, way_m %.4g",
                random.uniform(0.3, 1.2), random.uniform(0, 0.4), way_m);
  return text;
}

/// One run as it would have written itself.
class MadeRun {
 public:
  MadeRun(Database& database, const PreparedExperiment& prepared, const LargeDatabase& size, Id run)
      : database_(database),
        size_(size),
        genes_(database.run(run).genes),
        simulator_(database.latestSimulator(run)),
        run_(run),
        random_(Random::forPurpose(static_cast<std::uint64_t>(run), "large database")) {
    for (const Parameter& parameter : prepared.adapted) adapted_.push_back(parameter.byDefault);
    for (int k = 0; k < size.population; ++k) {
      std::string& chromosome = population_.emplace_back(genes_.size() * bitsOfAGene, '0');
      for (char& bit : chromosome) bit = random_.chance(0.5) ? '1' : '0';
    }
  }

  void learn(int number) {
    GenerationRecord generation;
    generation.run = run_;
    generation.number = number;
    generation.simulator = simulator_.id;
    generation.seconds = 1.5;
    generation.randomState = random_.state();
    generation.learnerState = hexadecimal(random_, learnerState_bytes);
    for (int slot = 0; slot < size_.population; ++slot) generation.individuals.push_back(individual(number, slot));
    double sum = 0;
    generation.best = generation.worst = generation.individuals[0].fitness;
    for (const IndividualRecord& i : generation.individuals) {
      generation.best = std::max(generation.best, i.fitness);
      generation.worst = std::min(generation.worst, i.fitness);
      sum += i.fitness;
      ++(i.sameAs == 0 ? generation.trials : generation.reused);
    }
    generation.mean = sum / size_.population;
    database_.addGeneration(generation);
  }

  void measure(int stage) {
    std::vector<MeasurementTask> tasks;
    for (const IndividualRecord& best : database_.bestIndividuals(run_, size_.measured, 0, 0)) {
      MeasurementTask& task = tasks.emplace_back();
      task.run = run_;
      task.stage = stage;
      task.individual = best.id;
      task.position = task.rank = static_cast<int>(tasks.size());
      task.simulatedFitness = best.fitness;
      task.wantedRepeats = size_.repeats;
    }
    database_.addMeasurementStage(run_, stage, tasks);
    std::vector<MeasurementRecord> values;
    for (const MeasurementTask& task : tasks) {
      const std::string hash = database_.individual(task.individual).traceSha256;
      if (size_.trace_bytes > 0) database_.setTrace(task.individual, bytes(random_, size_.trace_bytes), hash);
      for (int repeat = 0; repeat < size_.repeats; ++repeat)
        values.push_back({.run = run_,
                          .individual = task.individual,
                          .value = 0.8 * task.simulatedFitness + 0.02 * random_.normal(),
                          .source = "stand_in"});
    }
    database_.addMeasurements(values);
  }

  void adapt(int stage) {
    for (int number = 1; number <= size_.adaptations; ++number) {
      AdaptationRecord adaptation;
      adaptation.run = run_;
      adaptation.stage = stage;
      adaptation.number = number;
      adaptation.bestError = 0.2 / number;
      adaptation.meanError = 0.4 / number;
      adaptation.randomState = random_.state();
      adaptation.learnerState = hexadecimal(random_, learnerState_bytes / 3);
      for (int k = 0; k < size_.candidates; ++k) {
        AdaptationCandidate& candidate = adaptation.candidates.emplace_back();
        candidate.error = random_.uniform(0.1, 1);
        for (const double value : adapted_) {
          candidate.parameters.push_back(value * random_.uniform(0.8, 1.2));
          for (int bit = 0; bit < bitsOfAGene; ++bit) candidate.chromosome += random_.chance(0.5) ? '1' : '0';
        }
      }
      database_.addAdaptation(adaptation);
    }
    SimulatorRecord next = simulator_;
    next.id = 0;
    next.number = simulator_.number + 1;
    next.parent = simulator_.id;
    next.madeBy = "L3";
    next.evidence = "{}";
    next.madeAfterGeneration = database_.run(run_).generation;
    for (auto& [name, value] : next.simulator.values) value *= random_.uniform(0.98, 1.02);
    GapRecord gap;
    gap.run = run_;
    gap.stage = stage;
    gap.simulatorBefore = simulator_.id;
    gap.before = gap.newBefore = 0.3 / stage;
    gap.after = gap.newAfter = 0.1 / stage;
    gap.standardError = 0.01;
    gap.individuals = size_.measured * stage;
    database_.finishStage(next, gap, RunState::learning);
    simulator_ = database_.latestSimulator(run_);
  }

  void end() {
    RunProgress progress;
    progress.stage = "finished";
    progress.generation = progress.totalGenerations = size_.generations;
    progress.stageDone = progress.stageTotal = size_.generations;
    progress.trials = long{size_.generations} * size_.population;
    progress.trialsPerSecond = 33.2;
    progress.secondsLeft = 0;
    database_.setProgress(run_, toJsonText(progress));
    database_.setRunState(run_, RunState::finished, "");
  }

 private:
  // Copied from the population with a few bits turned; one in 64 stays as it was and is not simulated again.
  IndividualRecord individual(int generation, int slot) {
    IndividualRecord made;
    made.slot = slot;
    std::string& chromosome = population_[static_cast<std::size_t>(slot)];
    chromosome = population_[random_.below(population_.size())];
    if (slot > 0 && random_.chance(1.0 / 64)) {
      made.sameAs = sameAsSlot(slot - 1);
      chromosome = population_[static_cast<std::size_t>(slot) - 1];
    }
    if (made.sameAs == 0)
      for (char& bit : chromosome)
        if (random_.chance(mutation)) bit = bit == '0' ? '1' : '0';
    made.chromosome = chromosome;
    made.parameters = decodedGenes(chromosome, genes_, false);
    made.fitness = 2.0 * generation / (generation + 20.0) + 0.3 * random_.normal();
    made.detail = detailOfAKick(random_, made.fitness);
    made.trialSeed = random_.next();
    made.traceSha256 = hexadecimal(random_, 64);
    return made;
  }

  Database& database_;
  const LargeDatabase& size_;
  const std::vector<GeneBounds> genes_;
  SimulatorRecord simulator_;
  const Id run_;
  Random random_;
  std::vector<double> adapted_;
  std::vector<std::string> population_;
};

}  // namespace

void makeLargeDatabase(const std::string& path, const PluginHost& host, const std::string& experimentPath,
                       const LargeDatabase& size, const std::function<bool(int runsDone)>& goesOn) {
  if (std::filesystem::exists(path)) throw InputError(path + ": is there already; choose another name");
  const PreparedExperiment prepared = prepareFromFiles(loadExperiment(experimentPath), host);
  Database database = Database::open(path, Database::Mode::create);
  Id experiment = 0;
  for (int k = 0; k < size.runs; ++k) {
    PreparedExperiment named = prepared;
    if (k % size.runsOfAnExperiment == 0) {
      ExperimentRecord record;
      record.name = prepared.spec.name + ", " + std::to_string(1 + k / size.runsOfAnExperiment);
      named.specInWords.name = record.name;
      record.specJson = toJsonText(named.specInWords);
      experiment = database.addExperiment(record);
    }
    const auto seed = static_cast<std::uint64_t>(1 + k % size.runsOfAnExperiment);
    const Id run = database.addRun(makeRunRecord(named, experiment, seed), firstSimulator(named));
    MadeRun made(database, prepared, size, run);
    int stage = 0;
    for (int number = 1; number <= size.generations; ++number) {
      if (goesOn && !goesOn(k)) return;
      made.learn(number);
      if (stage < size.stages && number == (stage + 1) * size.generations / (size.stages + 1)) {
        made.measure(++stage);
        made.adapt(stage);
      }
    }
    made.end();
  }
}

}  // namespace btr
