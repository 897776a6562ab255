#include "core/remote/server.h"

#include <grpcpp/resource_quota.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "core/remote/services.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::remote {
namespace {

constexpr std::size_t largestKeyFile = 1u << 20;
/// What a socket's path may be at most on Linux.
constexpr std::size_t longestUnixPath = 100;

std::shared_ptr<grpc::ServerCredentials> credentialsOf(const Server::Options& options) {
  if (options.certificate.empty()) return grpc::InsecureServerCredentials();
  grpc::SslServerCredentialsOptions ssl;
  ssl.pem_key_cert_pairs.push_back(
      {readFile(options.key, largestKeyFile), readFile(options.certificate, largestKeyFile)});
  return grpc::SslServerCredentials(ssl);
}

void requireAllowed(const Server::Options& options) {
  if (options.address.empty() && options.unixPath.empty())
    throw InputError("--address", "none", "an address, or a Unix socket with --unix");
  if (options.certificate.empty() != options.key.empty())
    throw InputError("--tls", "one file", "a certificate and its key");
  if (options.unixPath.size() > longestUnixPath)
    throw InputError("--unix", options.unixPath, "at most " + std::to_string(longestUnixPath) + " characters");
  if (options.address.empty() || isLoopback(options.address)) return;
  if (options.certificate.empty() || options.gate.tokenFile.empty())
    throw InputError("--address", options.address + " without TLS and tokens",
                     "an address of this machine alone (127.0.0.1), or --tls CERT KEY and --token-file FILE");
}

}  // namespace

struct Server::Impl {
  Impl(const Options& given, Switchboard& switchboard)
      : options(given), gate(given.gate), desks(options, switchboard, gate), worlds(desks), learning(desks) {}

  const Options options;
  Gate gate;
  Desks desks;
  WorldsService worlds;
  LearningService learning;
  std::unique_ptr<grpc::Server> server;
  int port = 0;
};

Server::Server(const Options& options, Switchboard& switchboard) {
  requireAllowed(options);
  // What strangers send is answered, not written to the operator's terminal.
  setenv("GRPC_VERBOSITY", "NONE", 0);
  impl_ = std::make_unique<Impl>(options, switchboard);
  grpc::ServerBuilder builder;
  const auto credentials = credentialsOf(options);
  const bool v6 = options.address.find(':') != std::string::npos;
  const std::string address = v6 ? "[" + options.address + "]" : options.address;
  if (!options.address.empty())
    builder.AddListeningPort(address + ":" + std::to_string(options.port), credentials, &impl_->port);
  if (!options.unixPath.empty())
    builder.AddListeningPort("unix:" + options.unixPath,
                             options.address.empty() ? credentials : grpc::InsecureServerCredentials());

  // Every message, thread and byte is bounded.
  // Whoever comes too many is told so by a thread of its own.
  constexpr int spareThreads = 16;
  const int mostThreads = impl_->desks.threads() + spareThreads, mostCallsOfOne = mostThreads;
  constexpr std::size_t memory = 256u << 20;
  grpc::ResourceQuota quota("server");
  quota.SetMaxThreads(mostThreads).Resize(memory);
  builder.SetResourceQuota(quota);
  builder.SetMaxReceiveMessageSize(static_cast<int>(options.largestMessage));
  builder.SetMaxSendMessageSize(64 << 20);
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);  // nobody else may listen beside this
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, mostCallsOfOne);
  builder.AddChannelArgument(GRPC_ARG_MAX_METADATA_SIZE, 8192);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, 10000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, 600000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 60000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20000);
  // Clients that wait for long may ask whether the server is still there.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 10000);
  builder.SetSyncServerOption(grpc::ServerBuilder::SyncServerOption::NUM_CQS, 1);
  builder.SetSyncServerOption(grpc::ServerBuilder::SyncServerOption::MIN_POLLERS, 1);
  builder.SetSyncServerOption(grpc::ServerBuilder::SyncServerOption::MAX_POLLERS, 2);
  builder.RegisterService(&impl_->worlds);
  builder.RegisterService(&impl_->learning);
  // A socket that only its owner may open, from its first moment on.
  const mode_t before = umask(0177);
  impl_->server = builder.BuildAndStart();
  umask(before);
  if (!impl_->server || (!options.address.empty() && impl_->port <= 0))
    throw InputError("btr serve", where() + (options.port > 0 ? ":" + std::to_string(options.port) : ""),
                     "an address and port that are free, a certificate and key in PEM");
}

Server::~Server() {
  if (!impl_ || !impl_->server) return;
  impl_->desks.ends = true;
  impl_->server->Shutdown(std::chrono::system_clock::now() + std::chrono::milliseconds(500));
  if (!impl_->options.unixPath.empty()) unlink(impl_->options.unixPath.c_str());
}

int Server::port() const { return impl_->port; }

std::string Server::where() const {
  std::string text;
  const Options& options = impl_->options;
  if (!options.address.empty()) {
    const bool v6 = options.address.find(':') != std::string::npos;
    text = (v6 ? "[" + options.address + "]" : options.address) +
           (impl_->port > 0 ? ":" + std::to_string(impl_->port) : "");
  }
  if (!options.unixPath.empty()) text += (text.empty() ? "unix:" : " and unix:") + options.unixPath;
  return text;
}

bool Server::isToEnd() const { return impl_->desks.isToEnd; }

}  // namespace btr::remote
