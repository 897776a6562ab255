#include "core/remote/records_desk.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/remote/act_messages.h"
#include "core/remote/experiments.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/loop/waiting.h"
#include "core/run/reality/plausibility.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/spec/utf8.h"
#include "uchilsim.pb.h"

namespace btr::remote {
namespace {

namespace v1 = uchilsim::v1;

constexpr int mostRepeats = 1000;
constexpr std::size_t longestNote = 10000;

void fill(const Database& db, const RunRecord& run, v1::Run& out) {
  out.set_run(run.id);
  out.set_experiment(db.experiment(run.experiment).name);
  out.set_seed(run.seed);
  out.set_state(toText(run.state));
  out.set_generation(run.generation);
  out.set_stage(run.stage);
  out.set_reality(run.reality);
  out.set_message(messageNow(db, run));
  out.set_active(isRunActive(db.path(), run.id));
  const bool measures = !db.measurementTasks(run.id, run.stage + 1).empty();
  out.set_level(run.state == RunState::adapting ? "L3" : measures ? "L2" : "L1");
}

/// Those of the run's present measurement that are not settled, in the order to measure.
std::vector<MeasurementTask> openTasks(const Database& db, const RunRecord& run) {
  const std::vector<RealityIteration> finished = db.realityIterations(run.id);
  const std::vector<MeasurementRecord> measured = db.measurements(run.id);
  std::vector<MeasurementTask> tasks = db.measurementTasks(run.id, run.stage + 1);
  std::erase_if(tasks,
                [&](const MeasurementTask& task) { return isOver(task, finished) || isSettled(task, measured); });
  return tasks;
}

}  // namespace

const Database& RecordsDesk::reading() {
  if (path_.empty()) throw Refusal(Code::notNow, "this server has no database: btr serve --db FILE");
  if (!reading_) {
    if (!std::filesystem::exists(path_)) throw Refusal(Code::notFound, "no run was started in this database yet");
    reading_ = std::make_unique<Database>(Database::open(path_, Database::Mode::readOnly));
  }
  return *reading_;
}

Database& RecordsDesk::writing() {
  if (path_.empty()) throw Refusal(Code::notNow, "this server has no database: btr serve --db FILE");
  if (!writing_) writing_ = std::make_unique<Database>(Database::open(path_, Database::Mode::create));
  return *writing_;
}

std::string RecordsDesk::runs() {
  v1::RunsReply reply;
  if (!path_.empty() && !std::filesystem::exists(path_)) return reply.SerializeAsString();
  const Database& db = reading();
  for (const RunRecord& run : db.runs()) fill(db, run, *reply.add_runs());
  return reply.SerializeAsString();
}

std::string RecordsDesk::run(Id id) {
  v1::Run out;
  fill(reading(), reading().run(id), out);
  return out.SerializeAsString();
}

std::string RecordsDesk::generations(Id run, int after) {
  v1::GenerationsReply reply;
  reading().run(run);
  for (const GenerationRecord& g : reading().generations(run, after)) {
    v1::Generation& out = *reply.add_generations();
    out.set_number(g.number);
    out.set_best(g.best);
    out.set_mean(g.mean);
    out.set_worst(g.worst);
    out.set_trials(g.trials);
    out.set_failed(g.failed);
  }
  return reply.SerializeAsString();
}

std::string RecordsDesk::individuals(Id run, int generation) {
  if (generation < 1) throw InputError("generation", std::to_string(generation), "1 or more");
  v1::IndividualsReply reply;
  reading().run(run);
  for (const IndividualRecord& i : reading().individuals(run, generation)) {
    v1::Individual& out = *reply.add_individuals();
    out.set_individual(i.id);
    out.mutable_parameters()->Add(i.parameters.begin(), i.parameters.end());
    out.set_fitness(i.fitness);
    out.set_outcome(i.outcome);
  }
  return reply.SerializeAsString();
}

std::string RecordsDesk::start(const v1::StartRequest& request) {
  if (path_.empty()) throw Refusal(Code::notNow, "this server has no database: btr serve --db FILE");
  const ExperimentSpec spec = experimentOf(request.experiment(), folder_, host_);
  prepareFromFiles(spec, host_);  // before a database is made for it
  const Id id = startRun(writing(), host_, spec, request.has_seed() ? request.seed() : spec.seed, request.again());
  v1::Run out;
  fill(writing(), writing().run(id), out);
  return out.SerializeAsString();
}

std::string RecordsDesk::wanted(Id id) {
  const Database& db = reading();
  const RunRecord run = db.run(id);
  const PreparedExperiment prepared = prepareFromRun(run, host_);
  const std::vector<MeasurementRecord> measured = db.measurements(id);
  v1::MeasureReply reply;
  reply.set_unit(prepared.fitness->unit());
  for (const Parameter& parameter : prepared.genotype) remote::describe(parameter, *reply.add_parameters());
  // The simulated fitness stays hidden, so that nobody measures what he expects.
  for (const MeasurementTask& task : openTasks(db, run)) {
    v1::Task& out = *reply.add_tasks();
    out.set_individual(task.individual);
    out.set_wanted(task.wantedRepeats);
    out.set_have(static_cast<int>(
        std::ranges::count_if(measured, [&](const MeasurementRecord& m) { return m.individual == task.individual; })));
    const std::vector<double> parameters = db.individual(task.individual).parameters;
    out.mutable_parameters()->Add(parameters.begin(), parameters.end());
    out.set_stage(task.stage);
    out.set_iteration(task.iteration);
  }
  return reply.SerializeAsString();
}

std::string RecordsDesk::measured(const v1::MeasuredRequest& request) {
  reading();
  Database& db = writing();
  const RunRecord run = db.run(request.run());
  if (run.reality == "stand_in")
    throw Refusal(Code::notNow, "run " + std::to_string(run.id) + ": a stand-in answers its measurements");
  if (request.values_size() > mostRepeats || (request.values().empty() && !request.is_void()))
    throw InputError("values", std::to_string(request.values_size()) + " values",
                     "1 to " + std::to_string(mostRepeats) + ", or none for a void trial");
  if (request.note().size() > longestNote)
    throw InputError("note", std::to_string(request.note().size()) + " bytes",
                     "at most " + std::to_string(longestNote));
  MeasurementRecord m;
  m.run = run.id;
  m.individual = request.individual();
  m.isVoid = request.is_void();
  m.note = request.note();
  m.source = run.reality;
  m.who = request.who();
  m.enteredAt = utcNow();
  std::vector<MeasurementRecord> all;
  for (const double value : request.values()) {
    if (!(std::abs(value) <= largestFitness))
      throw InputError("value", std::isnan(value) ? "no number" : toText(value),
                       "-" + toText(largestFitness) + " to " + toText(largestFitness));
    m.value = value;
    all.push_back(m);
  }
  if (request.values().empty()) all.push_back(m);
  const PreparedExperiment prepared = prepareFromRun(run, host_);
  const KnownFitness known{db.measurementTasks(run.id), db.measurements(run.id), prepared.fitness->unit(),
                           prepared.fitness->canBeNegative()};
  const std::string refusal = whyRefused(doubts(known, all), request.sure(), "if it is right, send it as sure");
  if (!refusal.empty()) throw InputError(refusal);
  v1::MeasuredReply reply;
  for (const Id id : db.addMeasurements(all)) reply.add_measurements(id);
  db.moveLogIntoFile();
  return reply.SerializeAsString();
}

std::string RecordsDesk::answer(Method method, std::string_view message) {
  switch (method) {
    case Method::runs:
      messageOf<v1::RunsRequest>(message);
      return runs();
    case Method::generations: {
      const auto request = messageOf<v1::GenerationsRequest>(message);
      return generations(request.run(), request.after());
    }
    case Method::individuals: {
      const auto request = messageOf<v1::IndividualsRequest>(message);
      return individuals(request.run(), request.generation());
    }
    case Method::start:
      return start(messageOf<v1::StartRequest>(message));
    case Method::run:
      return run(messageOf<v1::StopRequest>(message).run());
    case Method::stop: {
      const Id id = messageOf<v1::StopRequest>(message).run();
      // Also for a run whose process is about to begin: forgetStop came before it.
      if (reading().run(id).state != RunState::finished) writing().requestStop(id, true);
      return run(id);
    }
    case Method::forgetStop: {
      const Id id = messageOf<v1::StopRequest>(message).run();
      forgetStop(writing(), id);
      return run(id);
    }
    case Method::wanted:
      return wanted(messageOf<v1::MeasureRequest>(message).run());
    case Method::measured:
      return measured(messageOf<v1::MeasuredRequest>(message));
    default:
      throw Refusal(Code::notThere, "the database does not answer this");
  }
}

}  // namespace btr::remote
