#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/remote/services.h"
#include "core/spec/parameter.h"
#include "core/spec/simulator_spec.h"

namespace btr::remote {
namespace {

using nlohmann::json;

/// Vectors that follow each other in one list.
void addVectors(const json& vectors, google::protobuf::RepeatedField<double>& out) {
  for (const json& vector : vectors)
    for (const json& number : vector) out.Add(number.get<double>());
}

/// What a learner asks (plugins/learners/remote.cpp), for a client.
void fill(const RunNews& news, const std::string& levelOfRun, v1::Question& out) {
  const json asked = json::parse(news.question);
  out.set_what(v1::Question::VECTORS);
  out.set_number(news.number);
  for (const json& p : asked.at("parameters")) {
    v1::NumberParts& parts = *out.add_parameters();
    parts.set_name(p.at("name").get<std::string>());
    parts.set_unit(p.at("unit").get<std::string>());
    parts.set_meaning(p.at("meaning").get<std::string>());
    parts.set_minimum(p.at("minimum").get<double>());
    parts.set_maximum(p.at("maximum").get<double>());
    parts.set_by_default(p.at("default").get<double>());
    parts.set_integer(p.at("integer").get<bool>());
    for (const json& choice : p.at("choices")) parts.add_choices(choice.get<std::string>());
  }
  // L3, which may breed while L2 waits, looks for numbers of the simulator; L1 and L2 for those of a controller.
  const bool ofSimulator =
      out.parameters_size() > 0 && find(simulatorParameters(), out.parameters(0).name()) != nullptr;
  out.set_level(ofSimulator ? "L3" : levelOfRun);
  out.set_population(asked.at("population").get<int>());
  const json& told = asked.at("told");
  out.set_vectors(static_cast<int>(told.at("vectors").size()));
  addVectors(told.at("vectors"), *out.mutable_told_parameters());
  for (const json& fitness : told.at("fitness")) out.add_told_fitness(fitness.get<double>());
  for (const json& number : asked.at("start")) out.add_start(number.get<double>());
  out.set_state(asked.at("state").get<std::string>());
}

/// An answer as the learner wants it. What is no number becomes null, which it refuses with its place.
std::string answerOf(const v1::TellRequest& request) {
  const int count = request.vectors();
  if (count < 1 || request.parameters_size() % count != 0)
    throw Refusal(Code::invalid, "parameters: " + std::to_string(request.parameters_size()) +
                                     " numbers is not allowed; as many for each of " + std::to_string(count) +
                                     " vectors");
  const int n = request.parameters_size() / count;
  json vectors = json::array();
  for (int i = 0; i < count; ++i) {
    json vector = json::array();
    for (int k = 0; k < n; ++k) {
      const double number = request.parameters(i * n + k);
      vector.push_back(std::isfinite(number) ? json(number) : json(nullptr));
    }
    vectors.push_back(std::move(vector));
  }
  return json{{"vectors", std::move(vectors)}, {"state", request.state()}}.dump();
}

void checkPatience(double patience_s) {
  if (!(patience_s >= 0))
    throw Refusal(Code::invalid,
                  "patience_s: " + (std::isnan(patience_s) ? std::string("no number") : toText(patience_s)) +
                      " is not allowed; a number of seconds, 0: 600");
}

}  // namespace

template <class Request, class Reply>
grpc::Status LearningService::pass(grpc::ServerContext* context, Role needed, Method method, const Request& request,
                                   Reply& reply) {
  return guardedCall(desks_, context, needed, [&](const Gate::Caller&) {
    take(desks_.switchboard.records(callOf(method, request.SerializeAsString()),
                                    [context] { return context->IsCancelled(); }),
         reply);
  });
}

v1::Run LearningService::ofRecords(Method method, std::int64_t run) {
  v1::StopRequest request;
  request.set_run(run);
  v1::Run out;
  take(desks_.switchboard.records(callOf(method, request.SerializeAsString())), out);
  return out;
}

void LearningService::begin(std::int64_t run, double patience_s) {
  const std::lock_guard lock(beginning_);
  if (!desks_.switchboard.runs().isHere(run)) ofRecords(Method::forgetStop, run);
  desks_.switchboard.runs().begin(run, patience_s);
}

v1::Run LearningService::runOf(std::int64_t run) {
  v1::Run out = ofRecords(Method::run, run);
  out.set_here(desks_.switchboard.runs().isHere(run));
  return out;
}

grpc::Status LearningService::Describe(grpc::ServerContext* context, const v1::ExperimentRequest* request,
                                       v1::ExperimentReply* reply) {
  return guardedCall(desks_, context, Role::watch, [&](const Gate::Caller&) {
    // By a process of its own: who only asks does not wait for others' trials.
    constexpr double patience_s = 60;
    take(desks_.switchboard.evaluate("describe", callOf(Method::describeExperiment, request->SerializeAsString()),
                                     patience_s, [context] { return context->IsCancelled(); }),
         *reply);
  });
}

grpc::Status LearningService::Evaluate(grpc::ServerContext* context, const v1::EvaluateRequest* request,
                                       v1::EvaluateReply* reply) {
  return guarded(desks_, context, Role::drive, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.evaluations, caller);
    constexpr double longest_s = 24 * 3600;
    const std::string key =
        request->run() != 0 ? "run " + std::to_string(request->run()) : request->experiment().SerializeAsString();
    take(desks_.switchboard.evaluate(key, callOf(Method::evaluate, request->SerializeAsString()), longest_s,
                                     [context] { return context->IsCancelled(); }),
         *reply);
  });
}

grpc::Status LearningService::Runs(grpc::ServerContext* context, const v1::RunsRequest* request, v1::RunsReply* reply) {
  const grpc::Status status = pass(context, Role::watch, Method::runs, *request, *reply);
  for (v1::Run& run : *reply->mutable_runs()) run.set_here(desks_.switchboard.runs().isHere(run.run()));
  return status;
}

grpc::Status LearningService::Generations(grpc::ServerContext* context, const v1::GenerationsRequest* request,
                                          v1::GenerationsReply* reply) {
  return pass(context, Role::watch, Method::generations, *request, *reply);
}

grpc::Status LearningService::Individuals(grpc::ServerContext* context, const v1::IndividualsRequest* request,
                                          v1::IndividualsReply* reply) {
  return pass(context, Role::watch, Method::individuals, *request, *reply);
}

grpc::Status LearningService::Start(grpc::ServerContext* context, const v1::StartRequest* request, v1::Run* reply) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller&) {
    checkPatience(request->patience_s());
    take(desks_.switchboard.records(callOf(Method::start, request->SerializeAsString())), *reply);
    begin(reply->run(), request->patience_s());
    *reply = runOf(reply->run());
  });
}

grpc::Status LearningService::Continue(grpc::ServerContext* context, const v1::ContinueRequest* request,
                                       v1::Run* reply) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller&) {
    checkPatience(request->patience_s());
    // That a run rests is stored before its process has left; one that is to stop first ends a generation.
    constexpr double leaving_s = 10;
    const std::string state = runOf(request->run()).state();
    if (state == "waiting" || state == "stopped" || state == "failed" ||
        desks_.switchboard.runs().isToStop(request->run()))
      desks_.switchboard.runs().awaitEnd(request->run(), leaving_s);
    begin(request->run(), request->patience_s());
    *reply = runOf(request->run());
  });
}

grpc::Status LearningService::Stop(grpc::ServerContext* context, const v1::StopRequest* request, v1::Run* reply) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller&) {
    take(desks_.switchboard.records(callOf(Method::stop, request->SerializeAsString())), *reply);
    desks_.switchboard.runs().end(request->run(), "it was stopped; continue the run at any time");
    reply->set_here(desks_.switchboard.runs().isHere(request->run()));
  });
}

grpc::Status LearningService::Ask(grpc::ServerContext* context, const v1::AskRequest* request, v1::Question* reply) {
  return guarded(desks_, context, Role::drive, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.streams, caller);  // it waits as long as one
    constexpr double longest_s = 30;
    const double wait_s = std::isfinite(request->wait_s()) ? std::clamp(request->wait_s(), 0.0, longest_s) : 0;
    using Clock = std::chrono::steady_clock;
    const auto until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait_s));
    const auto cancelled = [&] { return context->IsCancelled() || desks_.ends; };
    while (true) {
      const double left_s = std::chrono::duration<double>(until - Clock::now()).count();
      const RunNews news = desks_.switchboard.runs().news(request->run(), std::max(0.0, left_s), cancelled);
      if (news.what == RunNews::What::working) return;
      const v1::Run run = runOf(request->run());
      if (news.what == RunNews::What::asks) return fill(news, run.level(), *reply);
      reply->set_message(news.message.empty() ? run.message() : news.message);
      if (run.state() == "finished")
        reply->set_what(v1::Question::FINISHED);
      else if (run.state() == "waiting")
        reply->set_what(v1::Question::FITNESS);
      else if (!run.active())
        reply->set_what(v1::Question::STOPPED);
      // Another process works on it, which tells nobody: it is looked at again from time to time.
      if (reply->what() != v1::Question::WORKING || Clock::now() >= until || cancelled()) return;
      constexpr auto again = std::chrono::milliseconds(500);
      pause(desks_, *context, std::min<Clock::time_point>(until, Clock::now() + again));
    }
  });
}

grpc::Status LearningService::Tell(grpc::ServerContext* context, const v1::TellRequest* request, v1::TellReply*) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller&) {
    desks_.switchboard.runs().tell(request->run(), request->number(), answerOf(*request));
  });
}

grpc::Status LearningService::Wanted(grpc::ServerContext* context, const v1::MeasureRequest* request,
                                     v1::MeasureReply* reply) {
  return pass(context, Role::watch, Method::wanted, *request, *reply);
}

grpc::Status LearningService::Measured(grpc::ServerContext* context, const v1::MeasuredRequest* request,
                                       v1::MeasuredReply* reply) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller& caller) {
    v1::MeasuredRequest from = *request;
    from.set_who(caller.who);
    take(desks_.switchboard.records(callOf(Method::measured, from.SerializeAsString())), *reply);
  });
}

}  // namespace btr::remote
