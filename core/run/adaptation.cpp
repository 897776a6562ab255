// L3: a second learner changes the simulator's parameters until simulated and real fitness agree.
#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "core/run/reality_gap.h"
#include "core/run/run_context.h"
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
    for (const RealFitness& r : who) jobs.push_back({simulator, r.parameters, trialSeed, false});
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
  const auto replies = context.evaluate(jobs);
  if (!replies) return false;
  for (std::size_t i = 0; i < fresh.size(); ++i)
    known[fresh[i]->parameters] = gapFrom(evidence.shown, replies->data() + i * evidence.shown.size(), evidence.norm);
  return true;
}

/// What an interrupted adaptation has done already. Where a measured value was corrected since, its candidates are
/// simulated again: errors of other values are not to be compared.
struct Done {
  Error known;
  std::vector<AdaptationCandidate> all;
};
std::optional<Done> doneBefore(RunContext& context, const Evidence& evidence, const SimulatorSpec& base,
                               const std::vector<AdaptationRecord>& generations) {
  Done done;
  std::vector<Candidate> tried;
  for (const AdaptationRecord& generation : generations)
    for (const AdaptationCandidate& c : generation.candidates) {
      if (generation.evidenceSha256 == evidence.sha256) done.known.try_emplace(c.parameters, c.error);
      tried.push_back({c.chromosome, c.parameters});
      done.all.push_back(c);
    }
  if (!evaluateCandidates(context, evidence, base, tried, done.known)) return std::nullopt;
  for (AdaptationCandidate& c : done.all) c.error = done.known.at(c.parameters);
  return done;
}

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

}  // namespace

bool adaptSimulator(RunContext& context, int stage) {
  Database& db = context.database;
  const Id run = context.record.id;
  const SimulatorRecord parent = context.simulator();
  const Evidence evidence = collect(context, stage);
  const int generations = static_cast<int>(context.adaptationSetting("generations"));
  db.setRunState(run, RunState::adapting, "");

  const auto learner = context.host.learner(context.prepared.spec.adaptation.name);
  Random random = Random::forPurpose(context.record.seed, "L3", static_cast<std::uint64_t>(stage));
  learner->start(context.prepared.adapted, context.prepared.spec.adaptation.settings, random);
  // A population is drawn over all of the bounds, as in the papers; a learner with a centre begins at the parent.
  std::vector<double> present;
  for (const Parameter& p : context.prepared.adapted)
    present.push_back(valueOf(simulatorParameters(), parent.simulator.values, p.name));
  learner->beginAt(present, {.share = 0}, random);

  const std::vector<AdaptationRecord> earlier = db.adaptations(run, stage);
  auto done = doneBefore(context, evidence, parent.simulator, earlier);
  if (!done) return false;
  auto& [known, all] = *done;
  if (!earlier.empty()) {
    random.setState(earlier.back().randomState);
    learner->setState(earlier.back().learnerState);
  }
  int number = static_cast<int>(earlier.size());

  const int firstNumber = number;
  const auto begun = std::chrono::steady_clock::now();
  context.progress.stage = "L3";
  context.progress.stageTotal = generations;
  context.progress.stageDone = number;
  if (!earlier.empty()) {
    context.progress.best = earlier.back().bestError;
    context.progress.mean = earlier.back().meanError;
  }
  while (number < generations) {
    const std::vector<Candidate> candidates = learner->ask(random);
    if (!evaluateCandidates(context, evidence, parent.simulator, candidates, known)) return false;
    AdaptationRecord record;
    record.run = run;
    record.stage = stage;
    record.number = ++number;
    std::vector<double> errors;
    for (const Candidate& c : candidates) {
      errors.push_back(known.at(c.parameters));
      record.candidates.push_back({c.chromosome, c.parameters, errors.back()});
    }
    // The learner maximises: how much smaller the error is than the generation's worst.
    const double worst = *std::max_element(errors.begin(), errors.end());
    std::vector<double> fitness;
    for (double error : errors) fitness.push_back(worst - error);
    learner->tell(fitness);
    record.bestError = *std::min_element(errors.begin(), errors.end());
    record.meanError = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    record.randomState = random.state();
    record.learnerState = learner->state();
    record.evidenceSha256 = evidence.sha256;
    db.addAdaptation(record);
    all.insert(all.end(), record.candidates.begin(), record.candidates.end());

    context.progress.stageDone = number;
    context.progress.best = record.bestError;
    context.progress.mean = record.meanError;
    const double each =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() / (number - firstNumber);
    context.progress.secondsLeft = each * (generations - number);
    context.publish(false);
  }

  // The best of all candidates becomes the new version, unless its parent agrees better with reality.
  const auto before = gapsOf(context, evidence, parent.simulator);
  if (!before) return false;
  Error startError;
  if (!evaluateCandidates(context, evidence, parent.simulator, {{"", present}}, startError)) return false;
  const double parentError = startError.begin()->second;
  const auto best =
      std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.error < b.error; });
  const bool kept = best == all.end() || best->error >= parentError;

  SimulatorRecord version;
  version.run = run;
  version.number = parent.number + 1;
  version.parent = parent.id;
  version.simulator = kept ? parent.simulator : context.prepared.adaptedTo(parent.simulator, best->parameters);
  version.madeBy = "L3";
  version.evidence = evidenceText(evidence, stage, kept ? parentError : best->error, parentError, kept);
  version.madeAfterGeneration = context.measuredAfter(stage);
  version.createdAt = utcNow();
  const auto after = gapsOf(context, evidence, version.simulator);
  if (!after) return false;

  GapRecord gap;
  gap.run = run;
  gap.stage = stage;
  gap.simulatorBefore = parent.id;
  gap.before = before->shown;
  gap.after = after->shown;
  if (!evidence.heldOut.empty()) {
    gap.heldOutBefore = before->heldOut;
    gap.heldOutAfter = after->heldOut;
  }
  gap.newBefore = before->own;
  gap.newAfter = after->own;
  gap.standardError = gapStandardError(evidence.shown);
  gap.individuals = static_cast<int>(evidence.shown.size());
  gap.heldOutStandardError = gapStandardError(evidence.heldOut);
  gap.heldOutIndividuals = static_cast<int>(evidence.heldOut.size());
  const bool last = context.measuredAfter(stage) >= context.stageSetting("total_generations");
  db.finishStage(version, gap, last ? RunState::finished : RunState::learning);
  return true;
}

}  // namespace btr
