// Fitness alone: which effects would explain the differences, how strongly, and what would settle it.
#include "core/run/reality/fitness_clues.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/residual.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/search/report_words.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"
#include "core/spec/random.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

constexpr double largestSize = 3;  // typical sizes
constexpr std::size_t asked = 5;   // explanations that a recording must tell apart

/// A variant of a candidate and the fitness of all individuals with it.
struct Try {
  std::size_t candidate = 0;
  Values variant;
  std::vector<double> change;
};

class Clues {
 public:
  Clues(const Database& database, const PluginHost& host, Id run, const FitnessCluesOptions& options)
      : database_(database),
        host_(host),
        options_(options),
        record_(database.run(run)),
        prepared_(prepareFromRun(record_, host)),
        evaluator_(prepared_, options.workers) {
    result_.run = run;
  }

  FitnessClues find() {
    readMeasured();
    simulateAll();
    judgeAll();
    chooseRecording();
    say();
    return std::move(result_);
  }

 private:
  void report(const std::string& stage, double share) {
    if (options_.progress && !options_.progress(stage, share)) throw Cancelled{};
  }

  void readMeasured() {
    const auto tasks = database_.measurementTasks(result_.run);
    std::vector<RealFitness> all = realFitness(tasks, database_.measurements(result_.run), 1 << 30);
    for (const RealFitness& r : all) result_.stage = std::max(result_.stage, r.stage);
    bool repeated = true;
    for (const RealFitness& r : all) {
      if (r.stage != result_.stage) continue;
      result_.individuals.push_back(r.individual);
      result_.real.push_back(r.mean);
      result_.standardError.push_back(r.count > 1 ? r.standardDeviation / std::sqrt(r.count) : 0);
      repeated = repeated && result_.standardError.back() > 0;
      const IndividualRecord individual = database_.individual(r.individual);
      parameters_.push_back(individual.parameters);
      seeds_.push_back(individual.trialSeed);
    }
    if (result_.individuals.size() < 3)
      throw InputError("run " + std::to_string(result_.run),
                       std::to_string(result_.individuals.size()) + " measured individuals",
                       "at least three of one stage with a real fitness");
    for (const double error : result_.standardError) weights_.push_back(repeated ? 1 / (error * error) : 1);
    const SimulatorRecord newest = database_.latestSimulator(result_.run);
    result_.version = newest.number;
    simulator_ = newest.simulator;
    result_.unit = prepared_.fitness->unit();
  }

  SimulatorSpec with(const PlacedEffect& effect) const {
    SimulatorSpec changed = simulator_;
    changed.effects.push_back(effect);
    return changed;
  }
  void addJobs(std::vector<TrialJob>& jobs, const SimulatorSpec& simulator, bool wantTrace) const {
    for (std::size_t i = 0; i < parameters_.size(); ++i)
      jobs.push_back({simulator, parameters_[i], seeds_[i], wantTrace});
  }
  std::vector<TrialReply> evaluate(const std::vector<TrialJob>& jobs, const std::string& stage, double from,
                                   double to) {
    report(stage, from);
    std::atomic<bool> stop{false};
    const auto replies = evaluator_.evaluate(jobs, stop, [&](std::size_t done) {
      const double share = static_cast<double>(done) / static_cast<double>(jobs.size());
      if (options_.progress && !options_.progress(stage, from + (to - from) * share)) stop = true;
    });
    if (!replies) throw Cancelled{};
    return *replies;
  }

  void simulateAll() {
    const EffectLibrary library{host_.effectFactory(), host_.effects()};
    candidates_ = candidatesFor(prepared_.scene(simulator_), library, simulator_.effects, options_.names);
    result_.tried = candidates_.size();
    std::vector<TrialJob> jobs;
    addJobs(jobs, simulator_, false);
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      // A typical size in either direction.
      for (std::size_t v = 0; v < std::min<std::size_t>(2, candidates_[c].variants.size()); ++v) {
        tries_.push_back({c, candidates_[c].variants[v], {}});
        addJobs(jobs, with(candidates_[c].placed(tries_.back().variant)), false);
      }
    const auto replies = evaluate(jobs, "simulating with each effect", 0, 0.9);
    const std::size_t count = parameters_.size();
    for (std::size_t i = 0; i < count; ++i) {
      result_.simulated.push_back(replies[i].fitness);
      differences_.push_back(result_.real[i] - result_.simulated[i]);
    }
    result_.gap = gapOf(result_.real, result_.simulated, GapNorm::meanAbsolute);
    for (std::size_t t = 0; t < tries_.size(); ++t)
      for (std::size_t i = 0; i < count; ++i)
        tries_[t].change.push_back(replies[(t + 1) * count + i].fitness - result_.simulated[i]);
    // Where a trial did not come to its end, its fitness is no answer to the effect.
    std::vector<Try> answered;
    for (std::size_t t = 0; t < tries_.size(); ++t) {
      const auto of = std::span(replies).subspan((t + 1) * count, count);
      if (std::ranges::all_of(of, [](const TrialReply& reply) { return isFinished(reply.outcome); }))
        answered.push_back(std::move(tries_[t]));
    }
    tries_ = std::move(answered);
  }

  /// The largest share over all tries when the differences are dealt out at random, many times.
  std::vector<double> byChance() const {
    constexpr int deals = 999;
    Random random = Random::forPurpose(options_.seed, "fitness clues");
    std::vector<double> largest, differences = differences_, weights = weights_;
    for (int deal = 0; deal < deals; ++deal) {
      for (std::size_t i = differences.size() - 1; i > 0; --i) {
        const std::size_t other = random.below(i + 1);
        std::swap(differences[i], differences[other]);
        std::swap(weights[i], weights[other]);
      }
      double most = 0;
      for (const Try& attempt : tries_)
        most = std::max(most, bestShare(differences, attempt.change, weights, largestSize).share);
      largest.push_back(most);
    }
    std::sort(largest.begin(), largest.end());
    return largest;
  }

  void judgeAll() {
    const std::vector<double> chance = byChance();
    std::vector<FitnessClue> best(candidates_.size());
    for (const Try& attempt : tries_) {
      const BestShare found = bestShare(differences_, attempt.change, weights_, largestSize);
      FitnessClue& clue = best[attempt.candidate];
      if (found.share <= clue.share) continue;
      const EffectCandidate& candidate = candidates_[attempt.candidate];
      clue.effect = candidate.placed(scaledVariant(candidate, attempt.variant, found.a));
      clue.share = found.share;
      const auto above = chance.end() - std::lower_bound(chance.begin(), chance.end(), found.share);
      clue.pValue = (1.0 + static_cast<double>(above)) / (1.0 + static_cast<double>(chance.size()));
      clue.simulated.clear();
      for (std::size_t i = 0; i < attempt.change.size(); ++i)
        clue.simulated.push_back(result_.simulated[i] + found.a * attempt.change[i]);
    }
    for (FitnessClue& clue : best)
      if (clue.share > 0) result_.clues.push_back(std::move(clue));
    std::stable_sort(result_.clues.begin(), result_.clues.end(),
                     [](const FitnessClue& a, const FitnessClue& b) { return a.share > b.share; });
    for (const FitnessClue& clue : result_.clues)
      if (clue.share >= 0.8 * result_.clues[0].share) ++result_.alike;
  }

  /// Joint positions are what a robot can record by itself.
  void chooseRecording() {
    const std::size_t explanations = std::min(asked, result_.clues.size());
    if (explanations < 2) return;
    std::vector<TrialJob> jobs;
    for (std::size_t k = 0; k < explanations; ++k) addJobs(jobs, with(result_.clues[k].effect), true);
    const auto replies = evaluate(jobs, "looking for what would settle it", 0.9, 1);
    const std::size_t count = parameters_.size();
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<Trace> traces;
      for (std::size_t k = 0; k < explanations; ++k)
        if (const std::string& packed = replies[k * count + i].packedTrace; !packed.empty())
          traces.push_back(Trace::unpack(packed));
      if (traces.size() < 2) continue;
      std::size_t rows = traces[0].rows();
      for (const Trace& trace : traces) rows = std::min(rows, trace.rows());
      for (std::size_t column = 0; column < traces[0].channels.size(); ++column) {
        const std::string& channel = traces[0].channels[column];
        const auto name = parseChannel(channel);
        if (!name || (name->quantity != "position_rad" && name->quantity != "position_m")) continue;
        const double spread = spreadOf(traces, rows, column);
        if (spread <= result_.recordSpread) continue;
        result_.recordSpread = spread;
        result_.recordChannel = channel;
        result_.recordUnit = unitOfChannel(channel);
        result_.recordIndividual = result_.individuals[i];
      }
    }
  }

  static double spreadOf(const std::vector<Trace>& traces, std::size_t rows, std::size_t column) {
    double sum = 0;
    const auto n = static_cast<double>(traces.size());
    for (std::size_t row = 0; row < rows; ++row) {
      double mean = 0, square = 0;
      for (const Trace& trace : traces) mean += trace.at(row, column) / n;
      for (const Trace& trace : traces) square += std::pow(trace.at(row, column) - mean, 2) / (n - 1);
      sum += square;
    }
    return rows > 0 ? std::sqrt(sum / static_cast<double>(rows)) : 0;
  }

  static std::string nameOf(const FitnessClue& clue) { return inWords(clue.effect.effect, clue.effect.at); }

  void say() {
    std::string& text = result_.sentence;
    text = std::to_string(result_.individuals.size()) + " individuals were measured in stage " +
           std::to_string(result_.stage) + "; their real fitness differs from that of simulator version " +
           std::to_string(result_.version) + " by " + digits(result_.gap) + " " + result_.unit + " on average. ";
    if (result_.clues.empty()) {
      text += "No effect of the library at a usual size takes any of that away.";
      return;
    }
    const FitnessClue& best = result_.clues[0];
    text += "Of " + std::to_string(result_.tried) + " effects and places, " + nameOf(best) +
            " would take away most: " + wholePercent(best.share) + " of the squared differences. ";
    constexpr double usual = 0.05;
    if (best.pValue > usual)
      text += "The best of so many takes as much from the same differences dealt out at random in " +
              wholePercent(best.pValue) + " of the deals: these numbers alone are no evidence for it. ";
    else
      text += "Dealt out at random, the same differences would let the best do so in only " +
              wholePercent(best.pValue) + " of the deals: a hint, not a proof. ";
    if (result_.alike > 1)
      text += std::to_string(result_.alike - 1) + " other" + (result_.alike > 2 ? "s do" : " does") +
              " nearly as well, so fitness alone cannot tell them apart. ";
    if (result_.recordIndividual != 0)
      text += "Record individual " + std::to_string(result_.recordIndividual) +
              ": the best explanations differ most in " + result_.recordChannel + ", by " +
              digits(result_.recordSpread) + " " + result_.recordUnit +
              " on average; gap analysis of that recording would settle it.";
    while (!text.empty() && text.back() == ' ') text.pop_back();
  }

  const Database& database_;
  const PluginHost& host_;
  const FitnessCluesOptions& options_;
  RunRecord record_;
  PreparedExperiment prepared_;
  Evaluator evaluator_;
  SimulatorSpec simulator_;
  std::vector<std::vector<double>> parameters_;
  std::vector<std::uint64_t> seeds_;
  std::vector<double> weights_, differences_;
  std::vector<EffectCandidate> candidates_;
  std::vector<Try> tries_;
  FitnessClues result_;
};

}  // namespace

BestShare bestShare(const std::vector<double>& differences, const std::vector<double>& change,
                    const std::vector<double>& weights, double most) {
  double total = 0, product = 0, square = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    total += weights[i] * differences[i] * differences[i];
    product += weights[i] * differences[i] * change[i];
    square += weights[i] * change[i] * change[i];
  }
  if (!(total > 0) || !(square > 0) || !std::isfinite(square)) return {};
  const double a = std::clamp(product / square, 0.0, most);
  return {(2 * a * product - a * a * square) / total, a};
}

FitnessClues fitnessClues(const Database& database, const PluginHost& host, Id run,
                          const FitnessCluesOptions& options) {
  return Clues(database, host, run, options).find();
}

}  // namespace btr
