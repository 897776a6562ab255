#include <array>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/remote/services.h"
#include "core/remote/world_desk.h"
#include "core/sim/worker_pool.h"
#include "core/store/database.h"

namespace btr::remote {
namespace {

constexpr std::size_t logPart = 65536;

void sendFile(const std::string& path, const std::string& shown, grpc::ServerWriter<v1::LogPart>& writer) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Refusal(Code::internal, shown + ": cannot be read");
  // As it is now: a world that goes on may write as fast as this reads.
  const auto end = std::filesystem::file_size(path);
  v1::LogPart part;
  part.set_file(shown);
  std::string bytes(logPart, '\0');
  while (file && static_cast<std::uintmax_t>(file.tellg()) < end) {
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    // Only whole characters: names may have some of several bytes.
    auto count = static_cast<std::size_t>(file.gcount());
    if (count == 0) break;
    std::size_t back = 0;
    while (file && back < 3 && (static_cast<unsigned char>(bytes[count - 1 - back]) & 0xC0) == 0x80) ++back;
    if (file && (static_cast<unsigned char>(bytes[count - 1 - back]) & 0xC0) == 0xC0)
      count -= back + 1;
    else if (file && back > 0)
      count -= back;
    if (count < static_cast<std::size_t>(file.gcount()))
      file.seekg(-static_cast<std::streamoff>(static_cast<std::size_t>(file.gcount()) - count), std::ios::cur);
    part.set_text(bytes.substr(0, count));
    if (!writer.Write(part)) return;
  }
}

}  // namespace

template <class Request, class Reply>
grpc::Status WorldsService::pass(grpc::ServerContext* context, Role needed, Method method, const Request& request,
                                 Reply& reply) {
  return guardedCall(desks_, context, needed, [&](const Gate::Caller&) {
    take(world(*context, request.world(), callOf(method, request.SerializeAsString())), reply);
  });
}

Answer WorldsService::world(const grpc::ServerContext& context, const std::string& name,
                            const std::string& call) const {
  return desks_.switchboard.world(
      name, call, [&context] { return context.IsCancelled(); }, [this] { return desks_.ends.load(); });
}

void pause(const Desks& desks, const grpc::ServerContext& context, std::chrono::steady_clock::time_point until) {
  using Clock = std::chrono::steady_clock;
  while (Clock::now() < until && !context.IsCancelled() && !desks.ends)
    std::this_thread::sleep_for(std::min<Clock::duration>(until - Clock::now(), std::chrono::milliseconds(50)));
}

grpc::Status WorldsService::Info(grpc::ServerContext* context, const v1::InfoRequest*, v1::InfoReply* reply) {
  return guardedCall(desks_, context, Role::watch, [&](const Gate::Caller& caller) {
    const Switchboard::Options& options = desks_.switchboard.options();
    reply->set_version(programVersion());
    reply->set_schema("uchilsim.v1");
    reply->set_role(wordOf(caller.role));
    reply->set_largest_message_bytes(static_cast<std::int64_t>(desks_.options.largestMessage));
    reply->set_calls_per_second(desks_.options.gate.callsPerSecond);
    reply->set_most_worlds(options.mostWorlds);
    reply->set_most_periods(WorldDesk::mostPeriods);
    reply->set_most_streams(desks_.streams.ofOneClient());
    reply->set_most_evaluations(desks_.evaluations.ofOneClient());
    reply->set_has_database(!options.database.empty());
    reply->set_keeps_logs(options.folder.writable());
    reply->set_workers(options.jobs > 0 ? options.jobs : processorCount());
    for (const std::string& name : desks_.switchboard.host().controllers()) reply->add_controllers(name);
    for (const std::string& name : desks_.switchboard.host().effects()) reply->add_effects(name);
  });
}

grpc::Status WorldsService::List(grpc::ServerContext* context, const v1::ListWorldsRequest*,
                                 v1::ListWorldsReply* reply) {
  return guardedCall(desks_, context, Role::watch, [&](const Gate::Caller&) {
    for (const std::string& name : desks_.switchboard.worlds()) reply->add_worlds(name);
  });
}

grpc::Status WorldsService::Describe(grpc::ServerContext* context, const v1::DescribeRequest* request,
                                     v1::World* reply) {
  return pass(context, Role::watch, Method::describe, *request, *reply);
}

grpc::Status WorldsService::Get(grpc::ServerContext* context, const v1::GetRequest* request, v1::State* reply) {
  return pass(context, Role::watch, Method::get, *request, *reply);
}

grpc::Status WorldsService::Watch(grpc::ServerContext* context, const v1::WatchRequest* request,
                                  grpc::ServerWriter<v1::State>* writer) {
  return guarded(desks_, context, Role::watch, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.streams, caller);
    constexpr double slowest_hz = 0.1, fastest_hz = 1000;
    if (!(request->rate_hz() >= slowest_hz && request->rate_hz() <= fastest_hz))
      throw Refusal(Code::invalid, "rate_hz: " + std::to_string(request->rate_hz()) + " is not allowed; 0.1 to 1000");
    v1::GetRequest get;
    get.set_world(request->world());
    *get.mutable_wanted() = request->wanted();
    if (!get.wanted().has_channels_known()) get.mutable_wanted()->set_channels_known(0);
    std::string call = callOf(Method::get, get.SerializeAsString());
    using Clock = std::chrono::steady_clock;
    const auto each =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / request->rate_hz()));
    auto due = Clock::now();
    std::array<std::int64_t, 3> told{-1, -1, -1};
    while (!context->IsCancelled() && !desks_.ends) {
      desks_.gate.count(caller);
      v1::State state;
      take(this->world(*context, request->world(), call), state);
      const std::array<std::int64_t, 3> now{state.episode(), state.period(), state.channels_version()};
      // A client that does not read holds up nobody but this stream.
      if (now != told && !writer->Write(state)) return;
      // What was told is not told again.
      if (now != told) {
        get.mutable_wanted()->set_channels_known(state.channels_version());
        if (!state.lines().empty()) get.mutable_wanted()->set_lines_after(state.lines().rbegin()->number());
        call = callOf(Method::get, get.SerializeAsString());
      }
      told = now;
      due = std::max(due + each, Clock::now());
      pause(desks_, *context, due);
    }
  });
}

grpc::Status WorldsService::Log(grpc::ServerContext* context, const v1::LogRequest* request,
                                grpc::ServerWriter<v1::LogPart>* writer) {
  return guarded(desks_, context, Role::watch, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.streams, caller);
    const Answer files = this->world(*context, request->world(), callOf(Method::logFiles, ""));
    if (files.code != Code::ok) throw Refusal(files.code, files.bytes);
    const GamesFolder& folder = desks_.switchboard.options().folder;
    const std::size_t line = files.bytes.find('\n');
    for (const std::string& path : {files.bytes.substr(0, line), files.bytes.substr(line + 1)})
      sendFile(path, folder.shown(path), *writer);
  });
}

grpc::Status WorldsService::Robot(grpc::ServerContext* context, const v1::RobotRequest* request,
                                  v1::RobotReply* reply) {
  return pass(context, Role::watch, Method::robot, *request, *reply);
}

grpc::Status WorldsService::Picture(grpc::ServerContext* context, const v1::PictureRequest* request,
                                    v1::PictureReply* reply) {
  return pass(context, Role::drive, Method::picture, *request, *reply);
}

grpc::Status WorldsService::PictureMemory(grpc::ServerContext* context, const v1::PictureMemoryRequest* request,
                                          v1::PictureMemoryReply* reply) {
  if (!isOfThisMachine(context->peer()))
    return guardedCall(desks_, context, Role::drive, [](const Gate::Caller&) {
      throw Refusal(Code::notNow, "only a client on the server's machine can read its memory; Picture sends frames");
    });
  return pass(context, Role::drive, Method::pictureMemory, *request, *reply);
}

grpc::Status WorldsService::Pictures(grpc::ServerContext* context, const v1::PictureRequest* request,
                                     grpc::ServerWriter<v1::PictureReply>* writer) {
  return guarded(desks_, context, Role::drive, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.streams, caller);
    constexpr auto often = std::chrono::milliseconds(2);
    v1::PictureRequest next = *request;
    v1::PictureReply reply;
    while (!context->IsCancelled() && !desks_.ends) {
      take(this->world(*context, next.world(), callOf(Method::picture, next.SerializeAsString())), reply);
      if (reply.number() > 0) {
        desks_.gate.count(caller);
        if (!writer->Write(reply)) return;
        next.set_after(reply.number());
      }
      pause(desks_, *context, std::chrono::steady_clock::now() + often);
    }
  });
}

grpc::Status WorldsService::Open(grpc::ServerContext* context, const v1::OpenRequest* request, v1::World* reply) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller&) {
    take(desks_.switchboard.open(request->SerializeAsString(), [context] { return context->IsCancelled(); }), *reply);
  });
}

grpc::Status WorldsService::Close(grpc::ServerContext* context, const v1::CloseRequest* request,
                                  v1::CloseReply* reply) {
  return guardedCall(desks_, context, Role::drive, [&](const Gate::Caller&) {
    take(desks_.switchboard.close(request->world(), [context] { return context->IsCancelled(); }), *reply);
  });
}

grpc::Status WorldsService::Reset(grpc::ServerContext* context, const v1::ResetRequest* request, v1::State* reply) {
  return pass(context, Role::drive, Method::reset, *request, *reply);
}

grpc::Status WorldsService::Step(grpc::ServerContext* context, const v1::StepRequest* request, v1::State* reply) {
  return pass(context, Role::drive, Method::step, *request, *reply);
}

grpc::Status WorldsService::Steps(grpc::ServerContext* context,
                                  grpc::ServerReaderWriter<v1::State, v1::StepRequest>* stream) {
  return guarded(desks_, context, Role::drive, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.streams, caller);
    std::string world;
    std::int64_t known = 0;  // of its channels: none yet
    v1::StepRequest request;
    v1::State state;
    while (stream->Read(&request)) {
      desks_.gate.count(caller);
      if (!request.world().empty() && world != request.world()) {
        world = request.world();
        known = 0;
      }
      if (!request.wanted().has_channels_known()) request.mutable_wanted()->set_channels_known(known);
      take(this->world(*context, world, callOf(Method::step, request.SerializeAsString())), state);
      known = state.channels_version();
      if (!stream->Write(state)) return;
    }
  });
}

grpc::Status WorldsService::Poses(grpc::ServerContext* context, grpc::ServerReader<v1::PoseRequest>* reader,
                                  v1::PosesReply* reply) {
  return guarded(desks_, context, Role::drive, [&](const Gate::Caller& caller) {
    const Places::Place place(desks_.streams, caller);
    std::string world;
    v1::PoseRequest request;
    v1::PosesReply each;
    std::int64_t taken = 0;
    while (reader->Read(&request)) {
      desks_.gate.count(caller);
      if (!request.world().empty()) world = request.world();
      take(this->world(*context, world, callOf(Method::pose, request.SerializeAsString())), each);
      ++taken;
    }
    reply->set_taken(taken);
    reply->set_last_period(each.last_period());
  });
}

grpc::Status WorldsService::Play(grpc::ServerContext* context, const v1::PlayRequest* request, v1::State* reply) {
  return pass(context, Role::drive, Method::play, *request, *reply);
}

grpc::Status WorldsService::Type(grpc::ServerContext* context, const v1::TypeRequest* request, v1::TypeReply* reply) {
  return pass(context, Role::drive, Method::type, *request, *reply);
}

grpc::Status WorldsService::Save(grpc::ServerContext* context, const v1::SaveRequest* request, v1::SaveReply* reply) {
  return pass(context, Role::drive, Method::save, *request, *reply);
}

grpc::Status WorldsService::ShutDown(grpc::ServerContext* context, const v1::ShutDownRequest*, v1::ShutDownReply*) {
  return guarded(desks_, context, Role::administrate, [&](const Gate::Caller&) { desks_.isToEnd = true; });
}

}  // namespace btr::remote
