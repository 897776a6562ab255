#pragma once
// The two services of the schema. Only server.cpp and service_*.cpp include this: gRPC's headers take seconds.
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>

#include "core/remote/desk.h"
#include "core/remote/server.h"
#include "uchilsim.grpc.pb.h"

namespace btr::remote {

namespace v1 = uchilsim::v1;

/// Every call that is answered holds a thread: there may be only so many of a kind at once, and of one client half of
/// them. From any thread.
class Places {
 public:
  Places(int most, std::string kind) : most_(most), kind_(std::move(kind)) {}
  int most() const { return most_; }
  int ofOneClient() const { return (most_ + 1) / 2; }

  /// One of them, as long as this is there. Throws Refusal where there is none.
  class Place {
   public:
    Place(Places& places, const Gate::Caller& caller) : places_(places), name_(caller.name) {
      const std::lock_guard lock(places_.mutex_);
      const auto own = places_.taken_.find(name_);
      if (places_.all_ >= places_.most_ || (own != places_.taken_.end() && own->second >= places_.ofOneClient()))
        throw Refusal(Code::tooMuch, "too many " + places_.kind_ + " at once; " +
                                         std::to_string(places_.ofOneClient()) + " of one client, " +
                                         std::to_string(places_.most_) + " of all");
      ++places_.taken_[name_];
      ++places_.all_;
    }
    ~Place() {
      const std::lock_guard lock(places_.mutex_);
      if (--places_.taken_[name_] == 0) places_.taken_.erase(name_);
      --places_.all_;
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;

   private:
    Places& places_;
    const std::string name_;
  };

 private:
  const int most_;
  const std::string kind_;
  std::mutex mutex_;
  std::map<std::string, int> taken_;  ///< by caller
  int all_ = 0;
};

/// What both services share.
struct Desks {
  Desks(const Server::Options& given, Switchboard& passing, Gate& judging)
      : options(given),
        switchboard(passing),
        gate(judging),
        streams(given.mostStreams > 0 ? given.mostStreams : mostStreamsFor(passing.options().mostWorlds), "streams"),
        evaluations(given.mostEvaluations, "evaluations"),
        calls(mostStreamsFor(passing.options().mostWorlds), "calls") {}

  /// One client may step all worlds, and watch some beside.
  static int mostStreamsFor(int worlds) { return 2 * (worlds + 8); }
  /// Threads that all together may take.
  int threads() const { return streams.most() + evaluations.most() + calls.most(); }

  const Server::Options& options;
  Switchboard& switchboard;
  Gate& gate;
  std::atomic<bool> isToEnd{false}, ends{false};
  Places streams, evaluations, calls;
};

inline std::string metadataOf(const grpc::ServerContext& context, const char* key) {
  const auto& all = context.client_metadata();
  const auto found = all.find(key);
  return found == all.end() ? "" : std::string(found->second.data(), found->second.size());
}

inline grpc::Status statusOf(Code code, const std::string& sentence) {
  // What goes into a header must not be long.
  constexpr std::size_t longest = 2000;
  return {static_cast<grpc::StatusCode>(code), sentence.substr(0, longest)};
}

/// Judges the call, then does `work(caller)`.
template <class Work>
grpc::Status guarded(Desks& desks, grpc::ServerContext* context, Role needed, Work&& work) {
  try {
    const Gate::Caller caller = desks.gate.admit(context->peer(), metadataOf(*context, "authorization"), needed);
    work(caller);
    return grpc::Status::OK;
  } catch (const Refusal& refusal) {
    return statusOf(refusal.code, refusal.what());
  } catch (const std::exception& error) {
    return statusOf(Code::internal, error.what());
  }
}

/// The same for a call that is answered at once, or whose turn comes soon.
template <class Work>
grpc::Status guardedCall(Desks& desks, grpc::ServerContext* context, Role needed, Work&& work) {
  return guarded(desks, context, needed, [&](const Gate::Caller& caller) {
    const Places::Place place(desks.calls, caller);
    work(caller);
  });
}

/// The message of an answer, or its refusal.
template <class Message>
void take(const Answer& answer, Message& message) {
  if (answer.code != Code::ok) throw Refusal(answer.code, answer.bytes);
  if (!message.ParseFromString(answer.bytes)) throw Refusal(Code::internal, "an answer that cannot be read");
}

/// Sleeps until then, or until the call is cancelled or the server ends.
void pause(const Desks& desks, const grpc::ServerContext& context, std::chrono::steady_clock::time_point until);

class WorldsService final : public v1::Worlds::Service {
 public:
  explicit WorldsService(Desks& desks) : desks_(desks) {}

  grpc::Status Info(grpc::ServerContext*, const v1::InfoRequest*, v1::InfoReply*) override;
  grpc::Status List(grpc::ServerContext*, const v1::ListWorldsRequest*, v1::ListWorldsReply*) override;
  grpc::Status Describe(grpc::ServerContext*, const v1::DescribeRequest*, v1::World*) override;
  grpc::Status Get(grpc::ServerContext*, const v1::GetRequest*, v1::State*) override;
  grpc::Status Watch(grpc::ServerContext*, const v1::WatchRequest*, grpc::ServerWriter<v1::State>*) override;
  grpc::Status Log(grpc::ServerContext*, const v1::LogRequest*, grpc::ServerWriter<v1::LogPart>*) override;
  grpc::Status Robot(grpc::ServerContext*, const v1::RobotRequest*, v1::RobotReply*) override;
  grpc::Status Picture(grpc::ServerContext*, const v1::PictureRequest*, v1::PictureReply*) override;
  grpc::Status PictureMemory(grpc::ServerContext*, const v1::PictureMemoryRequest*, v1::PictureMemoryReply*) override;
  grpc::Status Pictures(grpc::ServerContext*, const v1::PictureRequest*,
                        grpc::ServerWriter<v1::PictureReply>*) override;
  grpc::Status Open(grpc::ServerContext*, const v1::OpenRequest*, v1::World*) override;
  grpc::Status Close(grpc::ServerContext*, const v1::CloseRequest*, v1::CloseReply*) override;
  grpc::Status Reset(grpc::ServerContext*, const v1::ResetRequest*, v1::State*) override;
  grpc::Status Step(grpc::ServerContext*, const v1::StepRequest*, v1::State*) override;
  grpc::Status Steps(grpc::ServerContext*, grpc::ServerReaderWriter<v1::State, v1::StepRequest>*) override;
  grpc::Status Poses(grpc::ServerContext*, grpc::ServerReader<v1::PoseRequest>*, v1::PosesReply*) override;
  grpc::Status Play(grpc::ServerContext*, const v1::PlayRequest*, v1::State*) override;
  grpc::Status Type(grpc::ServerContext*, const v1::TypeRequest*, v1::TypeReply*) override;
  grpc::Status Save(grpc::ServerContext*, const v1::SaveRequest*, v1::SaveReply*) override;
  grpc::Status ShutDown(grpc::ServerContext*, const v1::ShutDownRequest*, v1::ShutDownReply*) override;

 private:
  template <class Request, class Reply>
  grpc::Status pass(grpc::ServerContext* context, Role needed, Method method, const Request& request, Reply& reply);
  Answer world(const grpc::ServerContext& context, const std::string& name, const std::string& call) const;

  Desks& desks_;
};

class LearningService final : public v1::Learning::Service {
 public:
  explicit LearningService(Desks& desks) : desks_(desks) {}

  grpc::Status Describe(grpc::ServerContext*, const v1::ExperimentRequest*, v1::ExperimentReply*) override;
  grpc::Status Evaluate(grpc::ServerContext*, const v1::EvaluateRequest*, v1::EvaluateReply*) override;
  grpc::Status Runs(grpc::ServerContext*, const v1::RunsRequest*, v1::RunsReply*) override;
  grpc::Status Generations(grpc::ServerContext*, const v1::GenerationsRequest*, v1::GenerationsReply*) override;
  grpc::Status Individuals(grpc::ServerContext*, const v1::IndividualsRequest*, v1::IndividualsReply*) override;
  grpc::Status Start(grpc::ServerContext*, const v1::StartRequest*, v1::Run*) override;
  grpc::Status Continue(grpc::ServerContext*, const v1::ContinueRequest*, v1::Run*) override;
  grpc::Status Stop(grpc::ServerContext*, const v1::StopRequest*, v1::Run*) override;
  grpc::Status Ask(grpc::ServerContext*, const v1::AskRequest*, v1::Question*) override;
  grpc::Status Tell(grpc::ServerContext*, const v1::TellRequest*, v1::TellReply*) override;
  grpc::Status Wanted(grpc::ServerContext*, const v1::MeasureRequest*, v1::MeasureReply*) override;
  grpc::Status Measured(grpc::ServerContext*, const v1::MeasuredRequest*, v1::MeasuredReply*) override;

 private:
  v1::Run runOf(std::int64_t run);
  /// What records answer to a method whose message is the number of a run.
  v1::Run ofRecords(Method method, std::int64_t run);
  /// A process begins to work on the run, unless one does.
  void begin(std::int64_t run, double patience_s);
  template <class Request, class Reply>
  grpc::Status pass(grpc::ServerContext* context, Role needed, Method method, const Request& request, Reply& reply);

  Desks& desks_;
  std::mutex beginning_;  ///< nobody forgets a stop of a run that another call begins
};

}  // namespace btr::remote
