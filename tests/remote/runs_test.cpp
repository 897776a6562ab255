// Learners and robots outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/run/loop/back_to_reality.h"
#include "core/run/setup/run_lock.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "core/store/database.h"
#include "tests/remote/server_fixture.h"

namespace {

using namespace btr::test;
using testing::HasSubstr;

class RemoteRun : public ServerTest {
 protected:
  /// A small kick of two stages, whose learner and reality are outside.
  std::string experiment(const std::function<void(nlohmann::json&)>& settle = {}) const {
    nlohmann::json text =
        nlohmann::json::parse(btr::readFile((files.server() / "experiments/kick-short.json").string()));
    text["learner"] = {{"name", "remote"}};
    text["adaptation"]["learner"]["settings"]["population"] = 4;
    text["adaptation"]["settings"]["generations"] = 1;
    text["stages"] = {
        {"first_generations", 2}, {"next_generations", 1}, {"total_generations", 3}, {"measured_individuals", 2}};
    text["reality"] = "remote";
    if (settle) settle(text);
    return text.dump();
  }
  std::int64_t start(const Caller& caller, const std::string& json, double patience_s = 0) {
    v1::StartRequest request;
    request.mutable_experiment()->set_json(json);
    request.mutable_experiment()->set_directory("experiments");
    request.set_patience_s(patience_s);
    v1::Run run;
    const auto context = caller.context();
    const grpc::Status status = caller.learning->Start(context.get(), request, &run);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return run.run();
  }
  void goOn(const Caller& caller, std::int64_t number, double patience_s = 0) {
    v1::ContinueRequest request;
    request.set_run(number);
    request.set_patience_s(patience_s);
    v1::Run run;
    const auto context = caller.context();
    const grpc::Status status = caller.learning->Continue(context.get(), request, &run);
    EXPECT_TRUE(status.ok()) << status.error_message();
  }
  /// The next thing that the run says, whatever it takes.
  v1::Question ask(const Caller& caller, std::int64_t run) {
    v1::Question question;
    v1::AskRequest request;
    request.set_run(run);
    request.set_wait_s(20);
    do {
      const auto context = caller.context(60);
      const grpc::Status status = caller.learning->Ask(context.get(), request, &question);
      EXPECT_TRUE(status.ok()) << status.error_message();
      if (!status.ok()) break;
    } while (question.what() == v1::Question::WORKING);
    return question;
  }
  grpc::Status tell(const Caller& caller, std::int64_t run, const v1::Question& question,
                    const std::vector<std::vector<double>>& vectors, const std::string& state = "") {
    v1::TellRequest request;
    request.set_run(run);
    request.set_number(question.number());
    request.set_vectors(static_cast<int>(vectors.size()));
    for (const auto& vector : vectors)
      for (const double number : vector) request.add_parameters(number);
    request.set_state(state);
    v1::TellReply reply;
    const auto context = caller.context();
    return caller.learning->Tell(context.get(), request, &reply);
  }
  /// Three vectors near the middle of the bounds, other ones for each number.
  static std::vector<std::vector<double>> vectorsFor(const v1::Question& question) {
    std::vector<std::vector<double>> all;
    for (int i = 0; i < 3; ++i) {
      std::vector<double> vector;
      for (const v1::NumberParts& p : question.parameters()) {
        const double share = 0.4 + 0.05 * i + 0.01 * static_cast<double>(question.number());
        const double value = p.minimum() + (p.maximum() - p.minimum()) * share;
        vector.push_back(p.integer() ? std::round(value) : value);
      }
      all.push_back(vector);
    }
    return all;
  }
  grpc::Status measured(const Caller& caller, std::int64_t run, std::int64_t individual,
                        const std::vector<double>& values, bool isVoid = false, bool sure = false) {
    v1::MeasuredRequest request;
    request.set_run(run);
    request.set_individual(individual);
    for (const double value : values) request.add_values(value);
    request.set_is_void(isVoid);
    request.set_note("by a test");
    request.set_sure(sure);
    v1::MeasuredReply reply;
    const auto context = caller.context();
    return caller.learning->Measured(context.get(), request, &reply);
  }
  v1::MeasureReply wanted(const Caller& caller, std::int64_t run) {
    v1::MeasureRequest request;
    request.set_run(run);
    v1::MeasureReply reply;
    const auto context = caller.context();
    EXPECT_TRUE(caller.learning->Wanted(context.get(), request, &reply).ok());
    return reply;
  }
  std::vector<v1::Task> tasksOf(const Caller& caller, std::int64_t run) {
    const v1::MeasureReply reply = wanted(caller, run);
    return {reply.tasks().begin(), reply.tasks().end()};
  }
};

TEST_F(RemoteRun, ALearnerAndARobotOutsideTakeARunToItsEnd) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment());
  for (int generation = 1; generation <= 2; ++generation) {
    const v1::Question question = ask(caller, run);
    ASSERT_EQ(v1::Question::VECTORS, question.what()) << question.message();
    EXPECT_EQ("L1", question.level());
    EXPECT_EQ(25, question.parameters_size());
    EXPECT_EQ(generation == 1 ? 0 : 3, question.told_fitness_size());
    EXPECT_EQ(generation == 1 ? "" : "state 1", question.state());
    EXPECT_TRUE(tell(caller, run, question, vectorsFor(question), "state " + std::to_string(generation)).ok());
  }
  ASSERT_EQ(v1::Question::FITNESS, ask(caller, run).what());
  const v1::MeasureReply tasks = wanted(caller, run);
  ASSERT_EQ(2, tasks.tasks_size());
  EXPECT_EQ("m", tasks.unit());
  // What cannot be, and what nobody asked for, is refused; a void trial counts as measured and not as a value.
  EXPECT_EQ(
      grpc::StatusCode::INVALID_ARGUMENT,
      measured(caller, run, tasks.tasks(0).individual(), {std::numeric_limits<double>::quiet_NaN()}).error_code());
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, measured(caller, run, 1000000, {0.4}).error_code());
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, measured(caller, run, tasks.tasks(0).individual(), {}).error_code());
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT,
            measured(caller, run, tasks.tasks(0).individual(), {2e9}, false, true).error_code());
  EXPECT_TRUE(measured(caller, run, tasks.tasks(0).individual(), {0.4}, false, true).ok());
  // A slipped decimal point is asked about, as it is by btr fitness enter.
  EXPECT_THAT(measured(caller, run, tasks.tasks(0).individual(), {41}).error_message(), HasSubstr("send it as sure"));
  EXPECT_TRUE(measured(caller, run, tasks.tasks(1).individual(), {}, true).ok());
  EXPECT_EQ(0, wanted(caller, run).tasks_size());
  goOn(caller, run);
  v1::Question question = ask(caller, run);  // L3 is the experiment's own; L1 goes on in the better simulator
  ASSERT_EQ(v1::Question::VECTORS, question.what()) << question.message();
  EXPECT_TRUE(tell(caller, run, question, vectorsFor(question)).ok());
  question = ask(caller, run);
  ASSERT_EQ(v1::Question::FITNESS, question.what()) << question.message();
  for (const v1::Task& task : tasksOf(caller, run))
    EXPECT_TRUE(measured(caller, run, task.individual(), {0.1}, false, true).ok());
  goOn(caller, run);
  EXPECT_EQ(v1::Question::FINISHED, ask(caller, run).what());

  // It stands in the database like any other, and its trials have the same bits again.
  const btr::Database db = btr::Database::open(files.file("a.db"), btr::Database::Mode::readOnly);
  EXPECT_EQ(3u, db.generations(run).size());
  EXPECT_EQ(3u, db.simulators(run).size());
  EXPECT_EQ("remote", db.measurements(run).front().source);
  EXPECT_EQ("remote", db.measurements(run).front().who);
  EXPECT_EQ("by a test", db.measurements(run).front().note);
}

TEST_F(RemoteRun, AnAnswerThatIsNotAllowedIsSaidAndTheQuestionStays) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment());
  const v1::Question question = ask(caller, run);
  std::vector<std::vector<double>> vectors = vectorsFor(question);
  vectors[1][5] = std::numeric_limits<double>::quiet_NaN();
  grpc::Status status = tell(caller, run, question, vectors);
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, status.error_code());
  EXPECT_THAT(status.error_message(), HasSubstr("vector 1 " + question.parameters(5).name() + ": no number"));
  vectors[1][5] = 1e9;
  EXPECT_THAT(tell(caller, run, question, vectors).error_message(),
              HasSubstr("vector 1 " + question.parameters(5).name()));
  vectors[1].pop_back();
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, tell(caller, run, question, vectors).error_code());
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, tell(caller, run, question, {}).error_code());
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, tell(caller, run, question, {{1, 2}}).error_code());
  EXPECT_TRUE(tell(caller, run, question, vectorsFor(question)).ok());
  // Twice is no harm: a client that did not hear the answer says it again.
  EXPECT_TRUE(tell(caller, run, question, vectorsFor(question)).ok());
  v1::Question never = question;
  never.set_number(77);
  EXPECT_EQ(grpc::StatusCode::FAILED_PRECONDITION, tell(caller, run, never, vectorsFor(question)).error_code());
}

TEST_F(RemoteRun, ALearnerThatDiesGoesOnFromTheDatabaseAsIfNothingHadHappened) {
  // All numbers of a run whose learner answers each question by its number alone.
  const auto results = [&](const std::string& name, bool breaks) {
    begin([&](auto&, auto& passing) { passing.database = files.file(name); });
    std::int64_t run = 0;
    {
      const Caller caller(address);
      run = start(caller, experiment());
      const v1::Question question = ask(caller, run);
      EXPECT_TRUE(tell(caller, run, question, vectorsFor(question), "mine").ok());
      const v1::Question second = ask(caller, run);
      if (breaks) {
        // The server ends while the learner is asked; client and server begin again.
        begin([&](auto&, auto& passing) { passing.database = files.file(name); });
      } else {
        EXPECT_TRUE(tell(caller, run, second, vectorsFor(second), "again").ok());
      }
    }
    const Caller caller(address);
    if (breaks) {
      v1::RunsReply runs;
      const auto context = caller.context();
      EXPECT_TRUE(caller.learning->Runs(context.get(), v1::RunsRequest(), &runs).ok());
      EXPECT_EQ("stopped", runs.runs(0).state());
      EXPECT_THAT(runs.runs(0).message(), HasSubstr("continue the run at any time"));
      goOn(caller, run);
      const v1::Question question = ask(caller, run);
      EXPECT_EQ(2, question.number());
      EXPECT_EQ("mine", question.state());
      EXPECT_EQ(3, question.told_fitness_size());
      EXPECT_TRUE(tell(caller, run, question, vectorsFor(question), "again").ok());
    }
    EXPECT_EQ(v1::Question::FITNESS, ask(caller, run).what());
    const btr::Database db = btr::Database::open(files.file(name), btr::Database::Mode::readOnly);
    nlohmann::json all;
    for (const auto& i : db.individuals(run)) all.push_back({i.parameters, i.fitness, i.traceSha256});
    return all.dump();
  };
  EXPECT_EQ(results("whole.db", false), results("broken.db", true));
}

TEST_F(RemoteRun, ALearnerThatIsLateIsSaidAndTheRunStops) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment(), 0.2);
  // Nobody asks: the run waits for its learner for a fifth of a second.
  v1::RunsReply runs;
  do {
    runs.Clear();
    const auto context = caller.context();
    ASSERT_TRUE(caller.learning->Runs(context.get(), v1::RunsRequest(), &runs).ok());
  } while (runs.runs(0).state() != "stopped");
  EXPECT_THAT(runs.runs(0).message(), HasSubstr("has not answered"));
  goOn(caller, run);
  const v1::Question question = ask(caller, run);
  EXPECT_EQ(v1::Question::VECTORS, question.what());
}

TEST_F(RemoteRun, ARunThatIsStoppedWhileItEvaluatesAsksNoMoreAndGoesOnWhenItIsContinued) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment());
  const v1::Question first = ask(caller, run);
  ASSERT_EQ(v1::Question::VECTORS, first.what()) << first.message();
  ASSERT_TRUE(tell(caller, run, first, vectorsFor(first)).ok());
  v1::StopRequest request;
  request.set_run(run);
  v1::Run reply;
  EXPECT_TRUE(caller.learning->Stop(caller.context().get(), request, &reply).ok());
  EXPECT_EQ(v1::Question::STOPPED, ask(caller, run).what());
  goOn(caller, run);
  const v1::Question second = ask(caller, run);
  ASSERT_EQ(v1::Question::VECTORS, second.what()) << second.message();
  EXPECT_TRUE(tell(caller, run, second, vectorsFor(second)).ok());
}

TEST_F(RemoteRun, ARunThatIsContinuedAtOnceAfterItWasStoppedGoesOn) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment());
  ASSERT_EQ(v1::Question::VECTORS, ask(caller, run).what());
  v1::StopRequest request;
  request.set_run(run);
  v1::Run reply;
  EXPECT_TRUE(caller.learning->Stop(caller.context().get(), request, &reply).ok());
  goOn(caller, run);
  EXPECT_EQ(v1::Question::VECTORS, ask(caller, run).what());
}

TEST_F(RemoteRun, AStopThatComesBeforeTheRunsProcessHasBegunCounts) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment([](nlohmann::json& text) {
                                   text["learner"] = {{"name", "ga"}, {"settings", {{"population", 4}}}};
                                   text["stages"]["first_generations"] = text["stages"]["total_generations"] = 1000;
                                 }));
  v1::StopRequest request;
  request.set_run(run);
  for (int time = 0; time < 3; ++time) {
    v1::Run reply;
    EXPECT_TRUE(caller.learning->Stop(caller.context().get(), request, &reply).ok());
    EXPECT_EQ(v1::Question::STOPPED, ask(caller, run).what());
    goOn(caller, run);
  }
}

TEST_F(RemoteRun, ARunAtWorkGetsThePatienceThatItIsContinuedWithAndKeepsItWithoutOne) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment());
  ASSERT_EQ(v1::Question::VECTORS, ask(caller, run).what());
  goOn(caller, run, 0.2);
  goOn(caller, run);
  const auto stateOf = [&] {
    v1::RunsReply runs;
    EXPECT_TRUE(caller.learning->Runs(caller.context().get(), v1::RunsRequest(), &runs).ok());
    return runs.runs(0);
  };
  while (!HasFailure() && stateOf().state() != "stopped") continue;
  EXPECT_THAT(stateOf().message(), HasSubstr("has not answered"));
}

TEST_F(RemoteRun, PatienceIsATime) {
  begin();
  const Caller caller(address);
  v1::StartRequest request;
  request.mutable_experiment()->set_json(experiment());
  request.mutable_experiment()->set_directory("experiments");
  for (const double patience_s : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    request.set_patience_s(patience_s);
    v1::Run run;
    const grpc::Status status = caller.learning->Start(caller.context().get(), request, &run);
    EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, status.error_code());
    EXPECT_THAT(status.error_message(), HasSubstr("patience_s: "));
  }
}

TEST_F(RemoteRun, AServerThatEndsStopsItsRunsWhereTheyAre) {
  begin();
  std::int64_t run = 0;
  {
    const Caller caller(address);
    run = start(caller, experiment([](nlohmann::json& text) {
                  text["learner"] = {{"name", "ga"}, {"settings", {{"population", 4}}}};
                  text["stages"]["first_generations"] = text["stages"]["total_generations"] = 1000;
                }));
  }
  server.reset();
  switchboard.reset();
  const btr::Database db = btr::Database::open(files.file("a.db"), btr::Database::Mode::readOnly);
  EXPECT_EQ(btr::RunState::stopped, db.run(run).state);
}

TEST_F(RemoteRun, ALearnerOutsideAdaptsTheSimulatorToo) {
  begin();
  const Caller caller(address);
  const std::int64_t run =
      start(caller, experiment([](nlohmann::json& text) {
              text["learner"] = {{"name", "ga"}, {"settings", {{"population", 4}}}};
              text["adaptation"]["learner"] = {{"name", "remote"}, {"settings", {{"population", 3}}}};
            }));
  ASSERT_EQ(v1::Question::FITNESS, ask(caller, run).what());
  for (const v1::Task& task : tasksOf(caller, run))
    EXPECT_TRUE(measured(caller, run, task.individual(), {0.1}, false, true).ok());
  goOn(caller, run);
  const v1::Question question = ask(caller, run);
  ASSERT_EQ(v1::Question::VECTORS, question.what());
  EXPECT_EQ("L3", question.level());
  EXPECT_EQ(3, question.population());
  EXPECT_THAT(tell(caller, run, question, {vectorsFor(question)[0]}).error_message(), HasSubstr("1 vectors"));
  EXPECT_TRUE(tell(caller, run, question, vectorsFor(question)).ok());
  EXPECT_EQ(v1::Question::FITNESS, ask(caller, run).what());
}

TEST_F(RemoteRun, ALearnerOutsideLearnsInRealityToo) {
  begin();
  const Caller caller(address);
  const std::int64_t run = start(caller, experiment([](nlohmann::json& text) {
                                   text["learner"] = {{"name", "ga"}, {"settings", {{"population", 4}}}};
                                   text["reality_learning"] = {{"learner", {{"name", "remote"}}},
                                                               {"settings", {{"iterations", 1}, {"repeats", 1}}}};
                                 }));
  const auto measureAll = [&] {
    for (const v1::Task& task : tasksOf(caller, run))
      EXPECT_TRUE(measured(caller, run, task.individual(), {0.1}, false, true).ok());
    goOn(caller, run);
  };
  ASSERT_EQ(v1::Question::FITNESS, ask(caller, run).what());
  measureAll();
  const v1::Question question = ask(caller, run);
  ASSERT_EQ(v1::Question::VECTORS, question.what()) << question.message();
  EXPECT_EQ("L2", question.level());
  EXPECT_EQ(25, question.start_size());
  EXPECT_TRUE(tell(caller, run, question, vectorsFor(question)).ok());
  ASSERT_EQ(v1::Question::FITNESS, ask(caller, run).what());
  const std::vector<v1::Task> policies = tasksOf(caller, run);
  ASSERT_EQ(3u, policies.size());
  EXPECT_EQ(1, policies.front().iteration());
  // They are measured in a drawn order; their numbers are in the learner's.
  const v1::Task first = std::ranges::min(policies, {}, &v1::Task::individual);
  EXPECT_TRUE(std::ranges::equal(first.parameters(), vectorsFor(question)[0]));
  measureAll();
  EXPECT_EQ(v1::Question::FITNESS, ask(caller, run).what());  // of the next stage
  EXPECT_EQ(2, tasksOf(caller, run).front().stage());
}

TEST_F(RemoteRun, ARunThatAnotherProcessWorksOnIsAskedForAsLongAsAnyOther) {
  begin();
  const std::string path = files.file("a.db");
  btr::Id run = 0;
  {
    btr::Database db = btr::Database::open(path, btr::Database::Mode::create);
    const std::string spec = (files.server() / "experiments/kick-short.json").string();
    run = btr::startRun(db, plugins(), btr::loadExperiment(spec), 1);
  }
  const Caller caller(address);
  v1::AskRequest request;
  request.set_run(run);
  request.set_wait_s(0.7);
  v1::Question question;
  const auto asked = [&] {
    const auto context = caller.context();
    const grpc::Status status = caller.learning->Ask(context.get(), request, &question);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return question.what();
  };
  {
    const btr::RunLock other(path, run);
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_EQ(v1::Question::WORKING, asked());
    // Who asks again at once does not do so as often as he can.
    EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(700));
  }
  EXPECT_EQ(v1::Question::STOPPED, asked());
}

TEST_F(RemoteRun, WithoutADatabaseRunsAreSaidNotToBeThere) {
  begin([](auto&, auto& passing) { passing.database.clear(); });
  const Caller caller(address);
  v1::RunsReply runs;
  const auto context = caller.context();
  const grpc::Status status = caller.learning->Runs(context.get(), v1::RunsRequest(), &runs);
  EXPECT_EQ(grpc::StatusCode::FAILED_PRECONDITION, status.error_code());
  EXPECT_THAT(status.error_message(), HasSubstr("--db"));
}

}  // namespace
