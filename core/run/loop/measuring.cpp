// Between L1 and L3: who is measured in reality, in which order, and what the robot answers.
#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/run/loop/disagreement.h"
#include "core/run/loop/robot.h"
#include "core/run/loop/run_context.h"
#include "core/run/loop/waiting.h"
#include "core/run/reality/plausibility.h"
#include "core/run/reality/reality_gap.h"
#include "core/spec/error.h"

namespace btr {
namespace {

/// One who is measured, and why; see MeasurementTask.
struct Chosen {
  IndividualRecord individual;
  int rank = 0;
  std::optional<double> disagreement = {};
  int candidates = 0;
};

/// Those whose trial came to its end and who were not measured before, each parameter vector once: the best, of the
/// stage's last generation and filled up from the generations before it in this simulator, or of all generations in
/// this simulator; and of the last generation those about whom candidate simulators disagree most, if they do. Nothing
/// if stopped.
std::optional<std::vector<Chosen>> chooseMeasured(RunContext& context, int stage) {
  const Database& db = context.database;
  const Id run = context.record.id;
  std::set<std::vector<double>> taken;
  for (const MeasurementTask& task : db.measurementTasks(run)) taken.insert(db.individual(task.individual).parameters);
  const auto count = static_cast<std::size_t>(context.stageSetting("measured_individuals"));
  const auto disagreeing = static_cast<std::size_t>(context.stageSetting("disagreeing_individuals"));
  const int last = context.measuredAfter(stage);
  // A simulator that was taken after the last generation has none of its own yet.
  const int first = std::min(context.simulator().madeAfterGeneration + 1, last);
  const bool lastOnly = context.stageSetting("chosen_from") == 0;

  std::vector<Chosen> chosen;
  int rank = 0;
  const auto takeBest = [&](std::size_t until) {
    const auto take = [&](int from) {
      for (IndividualRecord& i : db.bestIndividuals(run, std::numeric_limits<int>::max(), from, last))
        if (chosen.size() < until && isFinished(i.outcome) && taken.insert(i.parameters).second)
          chosen.push_back({std::move(i), ++rank});
    };
    if (lastOnly) take(last);
    if (chosen.size() < until) take(first);
  };
  takeBest(count - disagreeing);
  if (disagreeing > 0) {
    std::vector<IndividualRecord> rest;
    for (IndividualRecord& i : db.bestIndividuals(run, std::numeric_limits<int>::max(), last, last))
      if (!taken.contains(i.parameters)) rest.push_back(std::move(i));
    context.progress.message = "candidate simulators are compared to choose whom to measure";
    const auto all = disagreements(context, rest, candidateSimulators(context, stage));
    context.progress.message.clear();
    if (!all) return std::nullopt;
    int place = 0;
    for (const Disagreement& d : *all)
      if (d.deviation > 0 && chosen.size() < count && taken.insert(d.individual.parameters).second)
        chosen.push_back({d.individual, ++place, d.deviation, d.candidates});
    takeBest(count);
  }
  return chosen;
}

/// Everybody was measured before: there is nothing new to adapt the simulator to, and learning goes on. Where no trial
/// came to its end there is nobody to measure at all.
void passOver(RunContext& context, int stage) {
  Database& db = context.database;
  const Id run = context.record.id;
  const int last = context.measuredAfter(stage);
  const std::vector<IndividualRecord> all = db.individuals(run, last);
  if (std::ranges::none_of(all, [](const IndividualRecord& i) { return isFinished(i.outcome); }))
    throw InputError("run " + std::to_string(run) + ", measurement stage " + std::to_string(stage) +
                     ": nobody can be measured, as no trial of generation " + std::to_string(last) +
                     " came to its end (the first: " + all.front().outcome + ", " + all.front().detail +
                     "); mend the experiment and start it anew");
  const bool isLast = last >= context.stageSetting("total_generations");
  db.passStage(run, stage, isLast ? RunState::finished : RunState::learning);
}

/// The tasks of one measurement: the stage's own, or those of an iteration of L2.
std::vector<MeasurementTask> tasksOf(const Database& db, Id run, int stage, int iteration) {
  std::vector<MeasurementTask> tasks = db.measurementTasks(run, stage);
  std::erase_if(tasks, [&](const MeasurementTask& t) { return t.iteration != iteration; });
  return tasks;
}

/// How often the parameters of each task were to be measured by the tasks before it: the stand-in's noise must not come
/// again when a policy is tried again.
std::map<Id, int> repeatsBefore(const Database& db, const std::vector<MeasurementTask>& tasks) {
  std::map<Id, int> before;
  if (tasks.empty()) return before;
  std::map<std::vector<double>, int> wanted;
  for (const MeasurementTask& task : db.measurementTasks(tasks.front().run)) {
    int& sum = wanted[db.individual(task.individual).parameters];
    before[task.individual] = sum;
    sum += task.wantedRepeats;
    if (task.individual == tasks.back().individual) break;
  }
  return before;
}

/// Refuses a robot's value that is not possible, or doubtful: nobody looks at it before L3 does. A person who finds a
/// doubtful one right enters it. A stand-in's noise may lie below 0, and its values are in no other unit.
void requirePlausible(const RunContext& context, const std::vector<MeasurementRecord>& done,
                      const MeasurementRecord& measured) {
  if (context.record.reality == "stand_in") return;
  const Database& db = context.database;
  const Fitness& fitness = *context.prepared.fitness;
  const KnownFitness known{db.measurementTasks(measured.run), done, fitness.unit(), fitness.canBeNegative()};
  const std::string run = std::to_string(measured.run), individual = std::to_string(measured.individual);
  const std::string refusal =
      whyRefused(doubts(known, {measured}), false,
                 "if it is right: btr fitness enter --db " + db.path() + " --run " + run + " --individual " +
                     individual + " --value " + toText(measured.value) + " --yes",
                 {"individual " + individual + ", measured by " + measured.who});
  if (!refusal.empty()) throw InputError(refusal);
}

/// Asks for all trials that are still missing and stores each answer at once; who has no answer yet is passed over.
/// False if stopped.
bool askRobot(RunContext& context, RealRobot& robot, const std::vector<MeasurementTask>& tasks,
              std::vector<MeasurementRecord>& done) {
  Database& db = context.database;
  const std::map<Id, int> before = repeatsBefore(db, tasks);
  for (const MeasurementTask& task : tasks) {
    const IndividualRecord individual = db.individual(task.individual);
    auto have = static_cast<int>(std::count_if(
        done.begin(), done.end(), [&](const MeasurementRecord& m) { return m.individual == task.individual; }));
    for (; have < task.wantedRepeats; ++have) {
      if (context.stopped()) return false;
      const auto answer = robot.measure(
          {context.record.id, task.individual, have, before.at(task.individual) + have, individual.parameters});
      if (context.stopped() && !answer) return false;
      if (!answer) break;
      MeasurementRecord measurement;
      measurement.run = context.record.id;
      measurement.individual = task.individual;
      measurement.value = answer->fitness;
      measurement.isVoid = answer->isVoid;
      measurement.note = answer->note;
      measurement.who = context.prepared.reality->who();
      measurement.source = context.record.reality;
      measurement.enteredAt = utcNow();
      requirePlausible(context, done, measurement);
      db.addMeasurement(measurement);
      done.push_back(measurement);
    }
    context.progress.stageDone = static_cast<int>(
        std::count_if(tasks.begin(), tasks.end(), [&](const MeasurementTask& t) { return isSettled(t, done); }));
    context.publish(false);
  }
  return true;
}

/// Opens the robot and asks it. The run waits whatever goes wrong there, and keeps what: nobody may have watched.
bool openAndAsk(RunContext& context, const std::vector<MeasurementTask>& tasks, std::vector<MeasurementRecord>& done) {
  try {
    const auto robot = openRobot(context);
    return !robot || askRobot(context, *robot, tasks, done);
  } catch (const InputError& error) {
    context.database.setRunState(context.record.id, RunState::waiting, error.what());
    throw;
  }
}

}  // namespace

bool beginMeasuring(RunContext& context, int stage) {
  Database& db = context.database;
  const Id run = context.record.id;
  auto choice = chooseMeasured(context, stage);
  if (!choice) return false;
  std::vector<Chosen>& chosen = *choice;
  if (chosen.empty()) {
    passOver(context, stage);
    return true;
  }

  // Their traces, for replay and for comparing with recordings.
  std::vector<TrialJob> jobs;
  for (const auto& [i, rank, disagreement, candidates] : chosen)
    jobs.push_back({db.simulator(i.simulator).simulator, i.parameters, i.trialSeed, true});
  const auto replies = context.evaluate(jobs);
  if (!replies) return false;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (!(*replies)[i].packedTrace.empty())
      db.setTrace(chosen[i].individual.id, keptTrace((*replies)[i].packedTrace), (*replies)[i].traceSha256);

  // A drawn order, so that neither the operator's skill nor the battery follows the simulated rank. The drawn last ones
  // are held out where the user wants that.
  Random random = Random::forPurpose(context.record.seed, "measuring order", static_cast<std::uint64_t>(stage));
  for (std::size_t i = chosen.size(); i > 1; --i) std::swap(chosen[i - 1], chosen[random.below(i)]);
  const int heldOut = static_cast<int>(context.adaptationSetting("held_out"));
  std::vector<MeasurementTask> tasks;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto left = static_cast<int>(chosen.size() - i);
    const Chosen& who = chosen[i];
    tasks.push_back({run, stage, who.individual.id, static_cast<int>(i) + 1, who.individual.fitness,
                     context.stageSetting("repeats"), left <= heldOut && i > 0, 0, who.rank, who.disagreement,
                     who.candidates});
  }
  db.addMeasurementStage(run, stage, tasks);
  return true;
}

bool completeMeasuring(RunContext& context, int stage, int iteration) {
  Database& db = context.database;
  const Id run = context.record.id;
  const std::vector<MeasurementTask> tasks = tasksOf(db, run, stage, iteration);
  std::vector<MeasurementRecord> done = db.measurements(run);
  const auto settled = [&] {
    return std::count_if(tasks.begin(), tasks.end(), [&](const MeasurementTask& t) { return isSettled(t, done); });
  };
  context.progress.stage = "measuring";
  context.progress.secondsLeft = -1;
  context.progress.stageTotal = static_cast<int>(tasks.size());
  context.progress.stageDone = static_cast<int>(settled());

  if (context.progress.stageDone < context.progress.stageTotal) {
    if (!openAndAsk(context, tasks, done)) return false;
    context.progress.stageDone = static_cast<int>(settled());
  }
  const int missing = context.progress.stageTotal - static_cast<int>(settled());
  const bool anyReal = !realFitness(tasks, done, stage).empty();
  context.progress.message = waitingText(stage, iteration, missing, static_cast<int>(tasks.size()), anyReal);
  context.publish(true);
  return missing == 0 && anyReal;
}

}  // namespace btr
