// A server, its clients, and what strangers try.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include "core/live/session.h"
#include "core/live/session_log.h"
#include "core/spec/json_reader.h"
#include "tests/refusal.h"
#include "tests/remote/server_fixture.h"

namespace {

using namespace btr::test;
using btr::remote::Server;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string tokensIn(const RemoteFolder& files) {
  const std::string path = files.file("tokens");
  std::ofstream(path) << "watch " << watcher << "\ndrive " << driver << "\nadministrate " << administrator << "\n";
  chmod(path.c_str(), 0600);
  return path;
}

/// A certificate for 127.0.0.1 and its key, made by OpenSSL's program.
bool makeCertificate(const RemoteFolder& files) {
  const std::string command =
      "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 -subj /CN=test "
      "-addext subjectAltName=IP:127.0.0.1 -keyout " +
      files.file("key.pem") + " -out " + files.file("cert.pem") + " 2> " + files.file("openssl.txt");
  return std::system(command.c_str()) == 0;
}

/// Processes that this one has made, the oldest first.
std::vector<pid_t> childrenOf(pid_t process) {
  const std::string number = std::to_string(process);
  std::ifstream list("/proc/" + number + "/task/" + number + "/children");
  return {std::istream_iterator<pid_t>(list), {}};
}

TEST_F(ServerTest, ListensOnThisMachineAloneUnlessItHasTlsAndTokens) {
  const auto said = [&](const std::function<void(Server::Options&)>& settle) {
    return refusal([&] { begin([&](auto& options, auto&) { settle(options); }); });
  };
  const std::string tokens = tokensIn(files);
  ASSERT_TRUE(makeCertificate(files));
  for (const char* other : {"0.0.0.0", "::", "192.168.1.1"}) {
    EXPECT_THAT(said([&](auto& o) { o.address = other; }), HasSubstr("without TLS and tokens"));
    EXPECT_THAT(said([&](auto& o) {
                  o.address = other;
                  o.gate.tokenFile = tokens;
                }),
                HasSubstr("without TLS and tokens"));
    EXPECT_THAT(said([&](auto& o) {
                  o.address = other;
                  o.certificate = files.file("cert.pem");
                  o.key = files.file("key.pem");
                }),
                HasSubstr("without TLS and tokens"));
  }
  EXPECT_EQ("accepted", said([&](auto& o) {
              o.address = "0.0.0.0";
              o.certificate = files.file("cert.pem");
              o.key = files.file("key.pem");
              o.gate.tokenFile = tokens;
            }));
  EXPECT_EQ("accepted", said([](auto&) {}));
}

TEST_F(ServerTest, APortThatIsTakenIsSaid) {
  begin();
  const int port = server->port();
  const auto other = std::make_unique<btr::remote::Switchboard>(switchboard->options(), plugins());
  EXPECT_THAT(refusal([&] {
                Server::Options options;
                options.port = port;
                const Server second(options, *other);
              }),
              HasSubstr("free"));
}

TEST_F(ServerTest, EachRoleMayDoItsOwnAndNoMore) {
  begin([&](auto& options, auto&) { options.gate.tokenFile = tokensIn(files); });
  const Caller nobody(address), stranger(address, "stranger-0123456789abcdef"), watch(address, watcher),
      drive(address, driver), administrate(address, administrator);
  EXPECT_EQ(grpc::StatusCode::UNAUTHENTICATED, nobody.info().error_code());
  EXPECT_EQ(grpc::StatusCode::UNAUTHENTICATED, stranger.info().error_code());
  v1::InfoReply info;
  EXPECT_TRUE(watch.info(&info).ok());
  EXPECT_EQ("watch", info.role());
  const v1::World world = drive.open("ball.json");
  EXPECT_EQ(grpc::StatusCode::PERMISSION_DENIED, watch.step(world.world(), 1).error_code());
  EXPECT_EQ(grpc::StatusCode::UNAUTHENTICATED, nobody.step(world.world(), 1).error_code());
  EXPECT_TRUE(drive.step(world.world(), 1).ok());
  EXPECT_TRUE(administrate.step(world.world(), 1).ok());
  v1::State state;
  v1::GetRequest get;
  get.set_world(world.world());
  {
    const auto context = watch.context();
    EXPECT_TRUE(watch.worlds->Get(context.get(), get, &state).ok());
    EXPECT_EQ(2, state.period());
  }
  v1::ShutDownReply reply;
  {
    const auto context = drive.context();
    EXPECT_EQ(grpc::StatusCode::PERMISSION_DENIED,
              drive.worlds->ShutDown(context.get(), v1::ShutDownRequest(), &reply).error_code());
    EXPECT_FALSE(server->isToEnd());
  }
  const auto context = administrate.context();
  EXPECT_TRUE(administrate.worlds->ShutDown(context.get(), v1::ShutDownRequest(), &reply).ok());
  EXPECT_TRUE(server->isToEnd());
}

TEST_F(ServerTest, WithTlsNobodyGetsInWithoutItNorWithAnotherCertificate) {
  ASSERT_TRUE(makeCertificate(files));
  begin([&](auto& options, auto&) {
    options.certificate = files.file("cert.pem");
    options.key = files.file("key.pem");
    options.gate.tokenFile = tokensIn(files);
  });
  grpc::SslCredentialsOptions trusted;
  trusted.pem_root_certs = btr::readFile(files.file("cert.pem"));
  EXPECT_TRUE(Caller(address, driver, grpc::SslCredentials(trusted)).info().ok());
  EXPECT_EQ(grpc::StatusCode::UNAUTHENTICATED, Caller(address, "", grpc::SslCredentials(trusted)).info().error_code());
  EXPECT_EQ(grpc::StatusCode::UNAVAILABLE, Caller(address, driver).info().error_code());
  ASSERT_TRUE(makeCertificate(files));
  grpc::SslCredentialsOptions other;
  other.pem_root_certs = btr::readFile(files.file("cert.pem"));
  EXPECT_EQ(grpc::StatusCode::UNAVAILABLE, Caller(address, driver, grpc::SslCredentials(other)).info().error_code());
}

TEST_F(ServerTest, AUnixSocketIsOpenToItsOwnerAlone) {
  begin([&](auto& options, auto&) {
    options.address.clear();
    options.unixPath = files.file("socket");
  });
  struct stat status {};
  ASSERT_EQ(0, stat(files.file("socket").c_str(), &status));
  EXPECT_EQ(0u, status.st_mode & 077u);
  EXPECT_TRUE(Caller("unix:" + files.file("socket")).info().ok());
  EXPECT_EQ("unix:" + files.file("socket"), server->where());
  server.reset();
  EXPECT_FALSE(fs::exists(files.file("socket")));
}

TEST_F(ServerTest, TwoClientsAtOnceEachHaveTheirOwnBits) {
  begin();
  // What one client alone gets is what each of two gets that step at the same time.
  const auto played = [&] {
    const Caller caller(address);
    const v1::World world = caller.open("dog.json");
    v1::State state;
    for (int i = 0; i < 50; ++i) EXPECT_TRUE(caller.step(world.world(), 2, &state).ok());
    std::string row;
    for (const double number : state.row()) row += btr::toText(number) + " ";
    return row;
  };
  const std::string alone = played();
  std::string first, second;
  std::thread other([&] { first = played(); });
  second = played();
  other.join();
  EXPECT_EQ(alone, first);
  EXPECT_EQ(alone, second);
}

TEST_F(ServerTest, AStreamOfStepsGivesWhatSingleCallsGive) {
  begin();
  const Caller caller(address);
  const v1::World one = caller.open("dog.json"), two = caller.open("dog.json");
  v1::State single, streamed;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(caller.step(one.world(), 1, &single).ok());
  const auto context = caller.context();
  const auto stream = caller.worlds->Steps(context.get());
  for (int i = 0; i < 20; ++i) {
    v1::StepRequest request;
    if (i == 0) request.set_world(two.world());
    request.set_periods(1);
    ASSERT_TRUE(stream->Write(request));
    ASSERT_TRUE(stream->Read(&streamed));
  }
  stream->WritesDone();
  EXPECT_TRUE(stream->Finish().ok());
  EXPECT_TRUE(std::ranges::equal(single.row(), streamed.row()));
}

TEST_F(ServerTest, AWorldThatItsClientLeftIsWholeInItsLog) {
  begin();
  v1::World world;
  {
    const Caller caller(address);
    world = caller.open("dog.json");
    const auto context = caller.context();
    const auto stream = caller.worlds->Steps(context.get());
    v1::StepRequest request;
    request.set_world(world.world());
    request.set_periods(5);
    v1::Hold& hold = *request.add_acts()->mutable_hold();
    hold.set_robot("red1");
    hold.set_joint("HEAD_PAN");
    hold.set_position(0.5);
    v1::State state;
    stream->Write(request);
    stream->Read(&state);
    context->TryCancel();  // it vanishes
    stream->Finish();
  }
  const Caller next(address);
  v1::State state;
  EXPECT_TRUE(next.step(world.world(), 1, &state).ok());
  EXPECT_EQ(6, state.period());
  server.reset();
  switchboard.reset();
  const btr::SessionLog log = btr::loadSessionLog((files.server() / world.log()).string());
  EXPECT_EQ(1u, log.acts.size());
  EXPECT_EQ(6, log.periods);
  EXPECT_FALSE(log.traceSha256.empty());
}

TEST_F(ServerTest, BodiesThatAreMovedFromOutsideStandInTheLog) {
  begin();
  const Caller caller(address);
  const v1::World world = caller.open("dog.json");
  const auto context = caller.context();
  v1::PosesReply reply;
  const auto writer = caller.worlds->Poses(context.get(), &reply);
  for (int i = 0; i < 5; ++i) {
    v1::PoseRequest pose;
    if (i == 0) pose.set_world(world.world());
    pose.set_object("ball");
    for (const double x : {0.1 * i, 0.0, 0.3}) pose.add_position_m(x);
    ASSERT_TRUE(writer->Write(pose));
  }
  writer->WritesDone();
  ASSERT_TRUE(writer->Finish().ok());
  EXPECT_EQ(5, reply.taken());
  v1::LogRequest request;
  request.set_world(world.world());
  const auto again = caller.context();
  const auto log = caller.worlds->Log(again.get(), request);
  std::string text;
  for (v1::LogPart part; log->Read(&part);) text += part.text();
  EXPECT_TRUE(log->Finish().ok());
  std::size_t places = 0;
  for (std::size_t at = 0; (at = text.find("\"act\":\"place\",\"", at)) != std::string::npos; ++at) ++places;
  EXPECT_EQ(5u, places);
}

TEST_F(ServerTest, AWorldThatPlaysGoesOnByItselfAndIsWatched) {
  begin();
  const Caller caller(address);
  v1::WatchRequest request;
  request.set_world(caller.open("ball.json").world());
  request.set_rate_hz(200);
  v1::PlayRequest play;
  play.set_world(request.world());
  play.set_speed(10);
  v1::State state;
  {
    const auto context = caller.context();
    ASSERT_TRUE(caller.worlds->Play(context.get(), play, &state).ok());
  }
  const auto context = caller.context();
  const auto watched = caller.worlds->Watch(context.get(), request);
  std::int64_t before = -1;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(watched->Read(&state));
    EXPECT_GT(state.period(), before);
    EXPECT_TRUE(state.playing());
    before = state.period();
  }
  context->TryCancel();
  watched->Finish();
}

TEST_F(ServerTest, ThereAreOnlySoManyWorldsAndAClosedOneMakesRoom) {
  begin([](auto&, auto& passing) { passing.mostWorlds = 2; });
  const Caller caller(address);
  const v1::World first = caller.open("ball.json");
  caller.open("ball.json");
  v1::OpenRequest request;
  request.set_game("ball.json");
  v1::World world;
  {
    const auto context = caller.context();
    const grpc::Status status = caller.worlds->Open(context.get(), request, &world);
    EXPECT_EQ(grpc::StatusCode::RESOURCE_EXHAUSTED, status.error_code());
    EXPECT_THAT(status.error_message(), HasSubstr("2 worlds already"));
  }
  v1::CloseRequest close;
  close.set_world(first.world());
  v1::CloseReply reply;
  {
    const auto context = caller.context();
    EXPECT_TRUE(caller.worlds->Close(context.get(), close, &reply).ok());
  }
  caller.open("ball.json");
  EXPECT_EQ(grpc::StatusCode::NOT_FOUND, caller.step(first.world(), 1).error_code());
}

TEST_F(ServerTest, AWorldThatNobodyCallsIsClosed) {
  begin([](auto& options, auto& passing) {
    passing.idle_s = 1;
    options.gate.callsPerSecond = 1e6;  // it asks as often as it can
  });
  const Caller caller(address);
  const v1::World world = caller.open("ball.json");
  // The janitor looks once a second; the test waits for what it does, however long that takes.
  v1::ListWorldsReply reply;
  do {
    std::this_thread::yield();
    reply.Clear();
    const auto context = caller.context();
    const grpc::Status status = caller.worlds->List(context.get(), v1::ListWorldsRequest(), &reply);
    ASSERT_TRUE(status.ok()) << status.error_message();
  } while (reply.worlds_size() > 0);
  EXPECT_TRUE(fs::exists(files.server() / world.log()));
}

TEST_F(ServerTest, FloodsAreAnsweredWithASentenceAndOthersStillGetIn) {
  begin([&](auto& options, auto&) {
    options.gate.tokenFile = tokensIn(files);
    options.gate.callsPerSecond = 50;
  });
  const Caller flood(address, watcher), other(address, driver);
  int refusals = 0;
  for (int i = 0; i < 500; ++i) refusals += flood.info().error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED;
  EXPECT_GT(refusals, 100);
  EXPECT_TRUE(other.info().ok());
}

TEST_F(ServerTest, AMessageThatIsTooLargeIsRefusedBeforeItIsRead) {
  begin();
  const Caller caller(address);
  v1::OpenRequest request;
  request.set_game_json(std::string(5u << 20, 'x'));
  v1::World world;
  const auto context = caller.context();
  EXPECT_EQ(grpc::StatusCode::RESOURCE_EXHAUSTED, caller.worlds->Open(context.get(), request, &world).error_code());
  EXPECT_TRUE(caller.info().ok());
}

TEST_F(ServerTest, StreamsAreBounded) {
  begin([](auto& options, auto&) { options.mostStreams = 6; });  // 3 of one client
  const Caller caller(address);
  const std::string world = caller.open("ball.json").world();
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<v1::StepRequest, v1::State>>> streams;
  v1::StepRequest request;
  request.set_world(world);
  v1::State state;
  for (int i = 0; i < 3; ++i) {
    contexts.push_back(caller.context());
    streams.push_back(caller.worlds->Steps(contexts.back().get()));
    ASSERT_TRUE(streams.back()->Write(request));
    ASSERT_TRUE(streams.back()->Read(&state));
  }
  const auto context = caller.context();
  const auto more = caller.worlds->Steps(context.get());
  EXPECT_FALSE(more->Read(&state));
  EXPECT_EQ(grpc::StatusCode::RESOURCE_EXHAUSTED, more->Finish().error_code());
  for (auto& each : contexts) each->TryCancel();
  for (auto& each : streams) each->Finish();
}

TEST_F(ServerTest, OneClientMayStepAllWorldsThatThereMayBe) {
  constexpr int worlds = 40;  // more than half of any fixed number of streams that there was
  begin([](auto&, auto& passing) { passing.mostWorlds = worlds; });
  const Caller caller(address);
  v1::InfoReply info;
  ASSERT_TRUE(caller.info(&info).ok());
  EXPECT_GE(info.most_streams(), worlds);
  v1::StepRequest request;
  request.set_world(caller.open("ball.json").world());
  v1::State state;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts;
  std::vector<std::unique_ptr<grpc::ClientReaderWriter<v1::StepRequest, v1::State>>> streams;
  for (int i = 0; i < worlds; ++i) {
    contexts.push_back(caller.context());
    streams.push_back(caller.worlds->Steps(contexts.back().get()));
    ASSERT_TRUE(streams.back()->Write(request));
    ASSERT_TRUE(streams.back()->Read(&state)) << i;
  }
  for (auto& each : contexts) each->TryCancel();
  for (auto& each : streams) each->Finish();
}

TEST_F(ServerTest, AStreamTellsItsChannelsAndWhatBecameOfThem) {
  begin();
  const Caller caller(address);
  v1::StepRequest request;
  request.set_world(caller.open("ball.json").world());
  const auto context = caller.context(), watching = caller.context();
  const auto steps = caller.worlds->Steps(context.get());
  v1::WatchRequest watch;
  watch.set_world(request.world());
  watch.set_rate_hz(1000);
  const auto watched = caller.worlds->Watch(watching.get(), watch);
  v1::State state, seen;
  const auto stepped = [&] {
    EXPECT_TRUE(steps->Write(request));
    EXPECT_TRUE(steps->Read(&state));
    return state.channels_size();
  };
  const int before = stepped();
  ASSERT_TRUE(watched->Read(&seen));
  EXPECT_GT(before, 0);
  EXPECT_EQ(before, seen.channels_size());
  EXPECT_EQ(0, stepped());
  // Somebody else adds an object: both are told, though nothing moves.
  v1::StepRequest add = request;
  add.add_acts()->set_json(R"({"act": "add", "ball": {"name": "b2"}})");
  v1::State added;
  {
    const auto made = caller.context();
    ASSERT_TRUE(caller.worlds->Step(made.get(), add, &added).ok());
  }
  ASSERT_TRUE(watched->Read(&seen));
  EXPECT_EQ(added.row_size(), seen.channels_size());
  EXPECT_EQ(added.row_size(), stepped());
  context->TryCancel();
  watching->TryCancel();
  steps->Finish();
  watched->Finish();
}

/// More trials than any test waits for.
v1::EvaluateRequest longEvaluation(const Caller& caller) {
  v1::ExperimentRequest asked;
  asked.mutable_experiment()->set_file("experiments/kick-short.json");
  v1::ExperimentReply described;
  const auto context = caller.context();
  EXPECT_TRUE(caller.learning->Describe(context.get(), asked, &described).ok());
  v1::EvaluateRequest request;
  *request.mutable_experiment() = asked.experiment();
  request.set_vectors(10000);
  for (int i = 0; i < request.vectors(); ++i)
    for (const v1::NumberParts& p : described.genotype()) request.add_parameters(p.by_default());
  return request;
}

TEST_F(ServerTest, EvaluationsAreBoundedAndSaySo) {
  begin([](auto& options, auto&) { options.mostEvaluations = 2; });  // 1 of one client
  const Caller caller(address);
  const v1::EvaluateRequest request = longEvaluation(caller);
  const auto one = caller.context(300), two = caller.context(300);
  grpc::Status statuses[2];
  const auto evaluate = [&](int i) {
    v1::EvaluateReply reply;
    statuses[i] = caller.learning->Evaluate((i == 0 ? one : two).get(), request, &reply);
    // Whichever came too late has its refusal; the other one computes no longer.
    (i == 0 ? two : one)->TryCancel();
  };
  std::thread other(evaluate, 0);
  evaluate(1);
  other.join();
  const auto& refused = statuses[0].error_code() == grpc::StatusCode::CANCELLED ? statuses[1] : statuses[0];
  EXPECT_EQ(grpc::StatusCode::RESOURCE_EXHAUSTED, refused.error_code());
  EXPECT_EQ("too many evaluations at once; 1 of one client, 2 of all", refused.error_message());
  EXPECT_TRUE(caller.info().ok());
}

TEST_F(ServerTest, WhoCancelsAnEvaluationSpoilsNobodyElses) {
  begin();
  const Caller caller(address);
  v1::EvaluateRequest large = longEvaluation(caller), small = large;
  small.set_vectors(1);
  small.mutable_parameters()->Truncate(small.parameters_size() / large.vectors());
  const auto call = [](const v1::EvaluateRequest& request) {
    return callOf(btr::remote::Method::evaluate, request.SerializeAsString());
  };
  constexpr double patience_s = 300;
  std::atomic<bool> computing{false}, cancelled{false};
  std::thread first([&] {
    const auto answer = switchboard->evaluate("same", call(large), patience_s, [&] {
      computing = true;
      return cancelled.load();
    });
    EXPECT_EQ(btr::remote::Code::cancelled, answer.code);
  });
  while (!computing) std::this_thread::yield();
  const auto answer = switchboard->evaluate("same", call(small), patience_s, [&] {
    cancelled = true;  // this one waits for its turn: now the first one goes
    return false;
  });
  first.join();
  EXPECT_EQ(btr::remote::Code::ok, answer.code) << answer.bytes;
}

TEST_F(ServerTest, AServerThatEndsDoesNotWaitForALongStep) {
  begin();
  v1::World world;
  {
    const Caller caller(address);
    world = caller.open("dog.json");
    // Longer than anybody waits: a stream of the longest steps that there may be.
    const auto context = caller.context(300);
    const auto stream = caller.worlds->Steps(context.get());
    v1::StepRequest request;
    request.set_world(world.world());
    v1::State state;
    ASSERT_TRUE(stream->Write(request));
    ASSERT_TRUE(stream->Read(&state));
    request.set_periods(10000);
    for (int i = 0; i < 1000; ++i) ASSERT_TRUE(stream->Write(request));
    server.reset();
    switchboard.reset();
    stream->Finish();
  }
  // It is ended as any other, and its log is whole.
  const btr::SessionLog log = btr::loadSessionLog((files.server() / world.log()).string());
  EXPECT_FALSE(log.traceSha256.empty());
}

TEST_F(ServerTest, AWorldWhoseProcessDiesIsSaidAndTheOthersGoOn) {
  begin();
  const Caller caller(address);
  const v1::World one = caller.open("dog.json"), two = caller.open("ball.json");
  // Its text is deeper than JSON may be, its numbers larger than any: none of them ends the process.
  v1::StepRequest request;
  request.set_world(one.world());
  request.add_acts()->set_json(std::string(1u << 20, '['));
  v1::State state;
  {
    const auto context = caller.context();
    EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, caller.worlds->Step(context.get(), request, &state).error_code());
  }
  EXPECT_TRUE(caller.step(one.world(), 1).ok());
  // A kill from outside: the server's nursery has made this world first.
  const std::vector<pid_t> nurseries = childrenOf(getpid());
  ASSERT_EQ(1u, nurseries.size());
  ASSERT_EQ(0, kill(childrenOf(nurseries.front()).front(), SIGKILL));
  const grpc::Status status = caller.step(one.world(), 1);
  EXPECT_EQ(grpc::StatusCode::UNAVAILABLE, status.error_code());
  EXPECT_THAT(status.error_message(), HasSubstr("the world has ended"));
  const v1::World three = caller.open("ball.json");
  EXPECT_TRUE(caller.step(three.world(), 1).ok());
  const btr::SessionLog log = btr::loadSessionLog((files.server() / one.log()).string());
  EXPECT_TRUE(log.acts.empty());
}

/// A connection that speaks no gRPC.
class RawConnection {
 public:
  explicit RawConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~RawConnection() { ::close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;
  bool connected() const { return connected_; }
  void say(const std::string& bytes) const {
    [[maybe_unused]] const auto n = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

 private:
  int socket_;
  bool connected_ = false;
};

TEST_F(ServerTest, RawBytesAndConnectionsThatSayNothingHoldUpNobody) {
  begin();
  const std::string preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", settings("\0\0\0\4\0\0\0\0\0", 9);
  std::mt19937 random(1);
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int i = 0; i < 200; ++i) {
    auto connection = std::make_unique<RawConnection>(server->port());
    ASSERT_TRUE(connection->connected());
    std::string noise;
    for (std::size_t left = random() % 2000; left > 0; --left) noise += static_cast<char>(random());
    switch (i % 5) {
      case 0:
        connection->say(noise);
        break;
      case 1:
        connection->say(preface + settings + noise);
        break;
      case 2:
        connection->say(preface.substr(0, random() % preface.size()));
        break;
      case 3:
        connection->say("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
        break;
      default:
        break;  // says nothing
    }
    if (i % 2) slow.push_back(std::move(connection));  // the others vanish at once
  }
  const Caller caller(address);
  EXPECT_TRUE(caller.info().ok());
  EXPECT_TRUE(caller.step(caller.open("ball.json").world(), 3).ok());
}

TEST_F(ServerTest, PicturesOfAServerWithoutCamerasAreSaidNotToBeThere) {
  begin();
  const Caller caller(address);
  v1::PictureRequest request;
  request.set_world(caller.open("dog.json").world());
  request.set_robot("red1");
  v1::PictureReply reply;
  const auto context = caller.context();
  const grpc::Status status = caller.worlds->Picture(context.get(), request, &reply);
  EXPECT_EQ(grpc::StatusCode::UNIMPLEMENTED, status.error_code());
  EXPECT_THAT(status.error_message(), HasSubstr("btr live --camera"));
}

/// A picture of the period's number, every fourth period.
class NumberEye final : public btr::CameraEye {
 public:
  std::optional<btr::CameraPicture> look(const btr::Session& session) override {
    if (session.periods() % 4 != 0 || session.periods() == 0) return std::nullopt;
    const auto shade = static_cast<std::uint8_t>(session.periods());
    return btr::CameraPicture{2, 1, {shade, shade, shade, 0, 0, 0}};
  }
};

TEST_F(ServerTest, PicturesComeAsTheWorldGoesOnEachOnce) {
  begin(
      [](auto&, auto& passing) { passing.cameras = [](const std::string&) { return std::make_unique<NumberEye>(); }; });
  const Caller caller(address);
  v1::PictureRequest request;
  request.set_world(caller.open("dog.json").world());
  request.set_robot("red1");
  v1::PictureReply reply;
  const auto ask = [&] {
    const auto context = caller.context();
    return caller.worlds->Picture(context.get(), request, &reply);
  };
  ASSERT_TRUE(ask().ok());
  EXPECT_EQ(0, reply.number());  // it begins to look
  ASSERT_TRUE(caller.step(request.world(), 9).ok());
  ASSERT_TRUE(ask().ok());
  EXPECT_EQ(2, reply.number());
  EXPECT_EQ(8, reply.period());
  EXPECT_EQ(std::string("\10\10\10\0\0\0", 6), reply.rgb());
  request.set_after(2);
  ASSERT_TRUE(ask().ok());
  EXPECT_EQ(0, reply.number());
  EXPECT_TRUE(reply.rgb().empty());
  const auto context = caller.context();
  const auto pictures = caller.worlds->Pictures(context.get(), request);
  ASSERT_TRUE(caller.step(request.world(), 3).ok());
  ASSERT_TRUE(pictures->Read(&reply));
  EXPECT_EQ(3, reply.number());
  context->TryCancel();
  pictures->Finish();
  request.set_robot("red2");
  EXPECT_EQ(grpc::StatusCode::INVALID_ARGUMENT, ask().error_code());
}

TEST_F(ServerTest, PicturesGoOnAfterAReset) {
  begin(
      [](auto&, auto& passing) { passing.cameras = [](const std::string&) { return std::make_unique<NumberEye>(); }; });
  const Caller caller(address);
  v1::PictureRequest request;
  request.set_world(caller.open("dog.json").world());
  request.set_robot("red1");
  v1::PictureReply reply;
  const auto ask = [&] {
    const auto context = caller.context();
    EXPECT_TRUE(caller.worlds->Picture(context.get(), request, &reply).ok());
    return reply.number();
  };
  EXPECT_EQ(0, ask());
  ASSERT_TRUE(caller.step(request.world(), 9).ok());
  EXPECT_EQ(2, ask());
  v1::ResetRequest reset;
  reset.set_world(request.world());
  v1::State state;
  {
    const auto context = caller.context();
    ASSERT_TRUE(caller.worlds->Reset(context.get(), reset, &state).ok());
  }
  // None of the last episode is shown, and whoever waits for the third one gets it.
  EXPECT_EQ(0, ask());
  request.set_after(2);
  EXPECT_EQ(0, ask());
  ASSERT_TRUE(caller.step(request.world(), 4).ok());
  EXPECT_EQ(3, ask());
  EXPECT_EQ(4, reply.period());
}

TEST_F(ServerTest, MemoryWithPicturesIsThereFromTheFirstOneUntilAReset) {
  begin(
      [](auto&, auto& passing) { passing.cameras = [](const std::string&) { return std::make_unique<NumberEye>(); }; });
  const Caller caller(address);
  v1::PictureMemoryRequest request;
  request.set_world(caller.open("dog.json").world());
  request.set_robot("red1");
  v1::PictureMemoryReply reply;
  const auto ask = [&] { return caller.call(&v1::Worlds::Stub::PictureMemory, *caller.worlds, request, reply); };
  ASSERT_TRUE(ask().ok());
  EXPECT_EQ("", reply.file());
  ASSERT_TRUE(caller.step(request.world(), 9).ok());
  ASSERT_TRUE(ask().ok());
  const auto word = [&](std::streamoff at) {
    std::ifstream in(reply.file(), std::ios::binary);
    std::uint64_t value = 0;
    in.seekg(at).read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
  };
  const std::string file = reply.file();
  const auto mark = reply.mark();
  EXPECT_EQ(mark, word(24));
  EXPECT_EQ(2u, word(32));
  EXPECT_EQ(static_cast<std::uintmax_t>(reply.bytes()), std::filesystem::file_size(file));
  ASSERT_TRUE(caller.step(request.world(), 4).ok());
  EXPECT_EQ(3u, word(32));
  // All clients read the same.
  ASSERT_TRUE(ask().ok());
  EXPECT_EQ(mark, reply.mark());

  v1::ResetRequest reset;
  reset.set_world(request.world());
  v1::State state;
  ASSERT_TRUE(caller.call(&v1::Worlds::Stub::Reset, *caller.worlds, reset, state).ok());
  EXPECT_FALSE(std::filesystem::exists(file));
  ASSERT_TRUE(ask().ok());
  EXPECT_EQ("", reply.file());
  ASSERT_TRUE(caller.step(request.world(), 4).ok());
  ASSERT_TRUE(ask().ok());
  EXPECT_NE(mark, reply.mark());
  EXPECT_EQ(4u, word(32));

  v1::CloseRequest close;
  close.set_world(request.world());
  v1::CloseReply closed;
  const std::string last = reply.file();
  ASSERT_TRUE(caller.call(&v1::Worlds::Stub::Close, *caller.worlds, close, closed).ok());
  EXPECT_FALSE(ask().ok());
  request.set_robot("red2");
  EXPECT_FALSE(ask().ok());
}

}  // namespace
