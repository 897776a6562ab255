#pragma once
// A server and its clients in one process.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "core/remote/services.h"
#include "tests/remote/remote_folder.h"

namespace btr::test {

namespace v1 = uchilsim::v1;

/// One client's connection.
class Caller {
 public:
  explicit Caller(const std::string& address, const std::string& token = "",
                  std::shared_ptr<grpc::ChannelCredentials> credentials = grpc::InsecureChannelCredentials())
      : token_(token) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // a connection of its own
    channel_ = grpc::CreateCustomChannel(address, credentials, arguments);
    worlds = v1::Worlds::NewStub(channel_);
    learning = v1::Learning::NewStub(channel_);
  }

  std::unique_ptr<grpc::ClientContext> context(double seconds = 30) const {
    auto made = std::make_unique<grpc::ClientContext>();
    made->set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(static_cast<long>(1000 * seconds)));
    if (!token_.empty()) made->AddMetadata("authorization", "Bearer " + token_);
    return made;
  }
  /// A call's status; `reply` as the server gave it.
  template <class Stub, class Request, class Reply>
  grpc::Status call(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Reply*), Stub& stub,
                    const Request& request, Reply& reply) const {
    const auto made = context();
    return (stub.*method)(made.get(), request, &reply);
  }

  std::unique_ptr<v1::Worlds::Stub> worlds;
  std::unique_ptr<v1::Learning::Stub> learning;

  v1::World open(const std::string& game) const {
    v1::OpenRequest request;
    request.set_game(game);
    v1::World world;
    const auto made = context();
    const grpc::Status status = worlds->Open(made.get(), request, &world);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return world;
  }
  grpc::Status step(const std::string& world, int periods, v1::State* out = nullptr) const {
    v1::StepRequest request;
    request.set_world(world);
    request.set_periods(periods);
    v1::State state;
    const auto made = context();
    return worlds->Step(made.get(), request, out ? out : &state);
  }
  grpc::Status info(v1::InfoReply* out = nullptr) const {
    v1::InfoReply reply;
    const auto made = context();
    return worlds->Info(made.get(), v1::InfoRequest(), out ? out : &reply);
  }

 private:
  std::string token_;
  std::shared_ptr<grpc::Channel> channel_;
};

class ServerTest : public testing::Test {
 protected:
  /// `settle` changes what the server allows before it begins.
  void begin(const std::function<void(remote::Server::Options&, remote::Switchboard::Options&)>& settle = {}) {
    remote::Server::Options options;
    remote::Switchboard::Options passing{remote::GamesFolder(files.server().string(), true)};
    passing.database = files.file("a.db");
    passing.jobs = 2;
    if (settle) settle(options, passing);
    server.reset();
    switchboard = std::make_unique<remote::Switchboard>(passing, plugins());
    server = std::make_unique<remote::Server>(options, *switchboard);
    address = "127.0.0.1:" + std::to_string(server->port());
  }

  RemoteFolder files;
  std::unique_ptr<remote::Switchboard> switchboard;
  std::unique_ptr<remote::Server> server;
  std::string address;
};

}  // namespace btr::test
