// L3: a second learner changes the simulator's parameters until simulated and real fitness agree.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "core/run/loop/learner_state.h"
#include "core/run/loop/run_context.h"
#include "core/run/reality/identified_numbers.h"
#include "core/run/reality/reality_gap.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

using Error = std::map<std::vector<double>, double>;

/// Real fitness of everybody measured so far, and what the adaptation compares it with.
struct Evidence {
  std::vector<RealFitness> shown, heldOut, own;  ///< own: of this stage alone, held out or not
  GapNorm norm = GapNorm::meanAbsolute;
  std::uint64_t trialSeed = 0;
  std::string sha256;  ///< of what the errors of candidates come from

  std::vector<TrialJob> jobs(const std::vector<RealFitness>& who, const SimulatorSpec& simulator) const {
    std::vector<TrialJob> jobs;
    for (const RealFitness& r : who)
      jobs.push_back({.simulator = simulator, .parameters = r.parameters, .seed = trialSeed, .fitnessOnly = true});
    return jobs;
  }
};

std::string hashOf(GapNorm norm, const std::vector<RealFitness>& shown) {
  Sha256 sha;
  const auto add = [&](const double* values, std::size_t count) {
    sha.add({reinterpret_cast<const char*>(values), count * sizeof(double)});
  };
  sha.add(std::to_string(static_cast<int>(norm)));
  for (const RealFitness& r : shown) {
    add(r.parameters.data(), r.parameters.size());
    add(&r.mean, 1);
  }
  return sha.finish();
}

Evidence collect(const RunContext& context, int stage) {
  Evidence evidence;
  evidence.norm = static_cast<GapNorm>(static_cast<int>(context.adaptationSetting("norm")));
  evidence.trialSeed = context.trialSeed();
  const Database& db = context.database;
  for (RealFitness& r :
       realFitness(db.measurementTasks(context.record.id), db.measurements(context.record.id), stage)) {
    if (r.iteration > 0 && context.adaptationSetting("sees_policies") == 0) continue;
    r.parameters = db.individual(r.individual).parameters;
    if (r.stage == stage) evidence.own.push_back(r);
    (r.heldOut ? evidence.heldOut : evidence.shown).push_back(std::move(r));
  }
  // A policy of L2 may repeat an individual that is held out.
  std::set<std::vector<double>> hidden;
  for (const RealFitness& r : evidence.heldOut) hidden.insert(r.parameters);
  std::erase_if(evidence.shown, [&](const RealFitness& r) { return hidden.contains(r.parameters); });
  evidence.sha256 = hashOf(evidence.norm, evidence.shown);
  return evidence;
}

double gapFrom(const std::vector<RealFitness>& real, const TrialReply* simulated, GapNorm norm) {
  std::vector<double> a, b;
  for (std::size_t i = 0; i < real.size(); ++i) {
    a.push_back(real[i].mean);
    b.push_back(simulated[i].fitness);
  }
  return gapOf(a, b, norm);
}

/// Mean absolute gaps of one simulator over the three groups.
struct Gaps {
  double shown = 0, heldOut = 0, own = 0;
};
std::optional<Gaps> gapsOf(RunContext& context, const Evidence& evidence, const SimulatorSpec& simulator) {
  std::vector<TrialJob> jobs;
  for (const auto* group : {&evidence.shown, &evidence.heldOut, &evidence.own})
    for (TrialJob& job : evidence.jobs(*group, simulator)) jobs.push_back(std::move(job));
  const auto replies = context.evaluate(jobs);
  if (!replies) return std::nullopt;
  const TrialReply* r = replies->data();
  Gaps gaps;
  gaps.shown = gapFrom(evidence.shown, r, GapNorm::meanAbsolute);
  gaps.heldOut = gapFrom(evidence.heldOut, r + evidence.shown.size(), GapNorm::meanAbsolute);
  gaps.own = gapFrom(evidence.own, r + evidence.shown.size() + evidence.heldOut.size(), GapNorm::meanAbsolute);
  return gaps;
}

/// Errors of the candidates, each parameter vector simulated once. False if stopped.
bool evaluateCandidates(RunContext& context, const Evidence& evidence, const SimulatorSpec& base,
                        const std::vector<Candidate>& candidates, Error& known) {
  std::vector<TrialJob> jobs;
  std::vector<const Candidate*> fresh;
  for (const Candidate& candidate : candidates) {
    if (!known.try_emplace(candidate.parameters, 0).second) continue;
    fresh.push_back(&candidate);
    for (TrialJob& job : evidence.jobs(evidence.shown, context.prepared.adaptedTo(base, candidate.parameters)))
      jobs.push_back(std::move(job));
  }
  if (fresh.empty()) return true;
  const auto replies = context.evaluate(jobs);
  if (!replies) return false;
  for (std::size_t i = 0; i < fresh.size(); ++i)
    known[fresh[i]->parameters] = gapFrom(evidence.shown, replies->data() + i * evidence.shown.size(), evidence.norm);
  return true;
}

/// The adaptation of one stage: its learner, and what every candidate was off by. All that it does is stored generation
/// by generation, so it may be left at any time and begun again.
class Adaptation {
 public:
  Adaptation(RunContext& context, int stage)
      : context_(context),
        stage_(stage),
        parent_(context.simulator()),
        evidence_(collect(context, stage)),
        generations_(static_cast<int>(context.adaptationSetting("generations"))) {}

  /// Takes up what was done before. Where a measured value was corrected since, its candidates are simulated again:
  /// errors of other values are not to be compared. False if stopped.
  bool begin();
  bool isBred() const { return number_ >= generations_; }
  /// One generation. False if stopped.
  bool breed();
  /// Stores the best of all candidates as the new version, unless its parent agrees better with reality. False if
  /// stopped.
  bool finish();

 private:
  RunContext& context_;
  const int stage_;
  const SimulatorRecord parent_;
  const Evidence evidence_;
  const int generations_;
  std::unique_ptr<Learner> learner_;
  Random random_ = Random::forPurpose(context_.record.seed, "L3", static_cast<std::uint64_t>(stage_));
  std::vector<double> present_;  ///< the parent's values of what may be adapted
  Error known_;
  std::vector<AdaptationCandidate> all_;
  int number_ = 0;
};

std::string evidenceText(const Evidence& evidence, int stage, double error, double startError, bool kept) {
  nlohmann::json individuals = nlohmann::json::array();
  for (const RealFitness& r : evidence.shown) individuals.push_back(r.individual);
  return nlohmann::json{{"stage", stage},
                        {"individuals", individuals},
                        {"sha256", evidence.sha256},
                        {"error", error},
                        {"error_of_parent", startError},
                        {"note", kept ? "no candidate was better than the parent: its values are kept" : ""}}
      .dump();
}

bool Adaptation::begin() {
  learner_ = context_.host.learner(context_.prepared.spec.adaptation.name);
  for (const Parameter& p : context_.prepared.adapted)
    present_.push_back(valueOf(simulatorParameters(), parent_.simulator.values, p.name));
  std::vector<Parameter> adapted = context_.prepared.adapted;
  if (const double wanted = context_.recordingSetting("told_numbers"); wanted > 0)
    adapted =
        withinIdentified(std::move(adapted), identifiedNumbers(context_.database.simulators(parent_.run), parent_),
                         present_, wanted == 2 ? Unidentified::stay : Unidentified::free);
  Values settings = context_.prepared.spec.adaptation.settings;
  // A step of one parameter may be wider than its narrowed bounds.
  for (const Parameter& p : learner_->settingsFor(adapted))
    if (const auto set = settings.find(p.name); set != settings.end())
      set->second = std::clamp(set->second, p.minimum, p.maximum);
  learner_->start(adapted, settings, random_);
  // A population is drawn over all of the bounds, as in the papers; a learner with a centre begins at the parent.
  learner_->beginAt(present_, {.share = 0}, random_);

  const std::vector<AdaptationRecord> earlier = context_.database.adaptations(context_.record.id, stage_);
  std::vector<Candidate> tried;
  for (const AdaptationRecord& generation : earlier)
    for (const AdaptationCandidate& c : generation.candidates) {
      if (generation.evidenceSha256 == evidence_.sha256) known_.try_emplace(c.parameters, c.error);
      tried.push_back({c.chromosome, c.parameters});
      all_.push_back(c);
    }
  if (!evaluateCandidates(context_, evidence_, parent_.simulator, tried, known_)) return false;
  for (AdaptationCandidate& c : all_) c.error = known_.at(c.parameters);
  number_ = static_cast<int>(earlier.size());
  context_.progress.stage = "L3";
  context_.progress.stageTotal = generations_;
  context_.progress.stageDone = number_;
  if (!earlier.empty()) {
    goOnFrom(earlier.back(), random_, *learner_);
    context_.progress.best = earlier.back().bestError;
    context_.progress.mean = earlier.back().meanError;
  }
  context_.publish(false);
  return true;
}

bool Adaptation::breed() {
  const std::vector<Candidate> candidates = learner_->ask(random_);
  if (!evaluateCandidates(context_, evidence_, parent_.simulator, candidates, known_)) return false;
  AdaptationRecord record;
  record.run = context_.record.id;
  record.stage = stage_;
  record.number = ++number_;
  std::vector<double> errors;
  for (const Candidate& c : candidates) {
    errors.push_back(known_.at(c.parameters));
    record.candidates.push_back({c.chromosome, c.parameters, errors.back()});
  }
  // The learner maximises: how much smaller the error is than the generation's worst.
  const double worst = *std::max_element(errors.begin(), errors.end());
  std::vector<double> fitness;
  for (double error : errors) fitness.push_back(worst - error);
  learner_->tell(fitness);
  record.bestError = *std::min_element(errors.begin(), errors.end());
  record.meanError = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  keepState(record, random_, *learner_);
  record.evidenceSha256 = evidence_.sha256;
  context_.database.addAdaptation(record);
  all_.insert(all_.end(), record.candidates.begin(), record.candidates.end());

  context_.planned.adaptersPopulation = static_cast<int>(candidates.size());
  if (context_.planned.learnersPopulation == 0)
    context_.planned.learnersPopulation =
        static_cast<int>(context_.database.individuals(context_.record.id, context_.progress.generation).size());
  context_.estimateTimeLeft(context_.progress.generation, stage_, number_);
  context_.progress.stageDone = number_;
  context_.progress.best = record.bestError;
  context_.progress.mean = record.meanError;
  context_.publish(false);
  return true;
}

bool Adaptation::finish() {
  const auto before = gapsOf(context_, evidence_, parent_.simulator);
  if (!before) return false;
  Error startError;
  if (!evaluateCandidates(context_, evidence_, parent_.simulator, {{"", present_}}, startError)) return false;
  const double parentError = startError.begin()->second;
  const auto best =
      std::min_element(all_.begin(), all_.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
  const bool kept = best == all_.end() || best->error >= parentError;

  SimulatorRecord version;
  version.run = context_.record.id;
  version.number = parent_.number + 1;
  version.parent = parent_.id;
  version.simulator = kept ? parent_.simulator : context_.prepared.adaptedTo(parent_.simulator, best->parameters);
  version.madeBy = "L3";
  version.evidence = evidenceText(evidence_, stage_, kept ? parentError : best->error, parentError, kept);
  version.madeAfterGeneration = context_.measuredAfter(stage_);
  version.createdAt = utcNow();
  const auto after = gapsOf(context_, evidence_, version.simulator);
  if (!after) return false;

  GapRecord gap;
  gap.run = context_.record.id;
  gap.stage = stage_;
  gap.simulatorBefore = parent_.id;
  gap.before = before->shown;
  gap.after = after->shown;
  if (!evidence_.heldOut.empty()) {
    gap.heldOutBefore = before->heldOut;
    gap.heldOutAfter = after->heldOut;
  }
  gap.newBefore = before->own;
  gap.newAfter = after->own;
  gap.standardError = gapStandardError(evidence_.shown);
  gap.individuals = static_cast<int>(evidence_.shown.size());
  gap.heldOutStandardError = gapStandardError(evidence_.heldOut);
  gap.heldOutIndividuals = static_cast<int>(evidence_.heldOut.size());
  const bool last = context_.measuredAfter(stage_) >= context_.stageSetting("total_generations");
  context_.database.finishStage(version, gap, last ? RunState::finished : RunState::learning);
  return true;
}

/// Whether a person has nothing to measure in this stage, or does not want to go on with it.
bool isPersonDone(const RunContext& context, int stage) {
  const Database& db = context.database;
  if (db.isRealityLearningEnded(context.record.id, stage)) return true;
  const std::vector<MeasurementRecord> values = db.measurements(context.record.id);
  const std::vector<MeasurementTask> tasks = db.measurementTasks(context.record.id, stage);
  return std::all_of(tasks.begin(), tasks.end(), [&](const MeasurementTask& t) { return isSettled(t, values); });
}

}  // namespace

StageEnd adaptMeanwhile(RunContext& context, int stage) {
  if (context.adaptationSetting("sees_policies") == 1) return StageEnd::waiting;
  const RunProgress asked = context.progress;
  Adaptation adaptation(context, stage);
  if (!adaptation.begin()) return StageEnd::stopped;
  while (!adaptation.isBred()) {
    if (!adaptation.breed()) return StageEnd::stopped;
    if (isPersonDone(context, stage)) return StageEnd::done;
  }
  const long trials = context.progress.trials;
  context.progress = asked;
  context.progress.trials = trials;
  context.publish(true);
  return StageEnd::waiting;
}

bool adaptSimulator(RunContext& context, int stage) {
  context.database.setRunState(context.record.id, RunState::adapting, "");
  Adaptation adaptation(context, stage);
  if (!adaptation.begin()) return false;
  while (!adaptation.isBred())
    if (!adaptation.breed()) return false;
  return adaptation.finish();
}

}  // namespace btr
