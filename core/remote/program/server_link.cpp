#include "core/remote/program/server_link.h"

#include <sstream>

#include "core/spec/json_reader.h"

namespace btr::remote {
namespace {

bool isThisMachine(const std::string& server) {
  for (const char* begin : {"127.", "localhost:", "[::1]:", "unix:"})
    if (server.starts_with(begin)) return true;
  return false;
}

std::string tokenIn(const std::string& file) {
  std::istringstream text(readFile(file));
  std::string token, more;
  if (!(text >> token) || text >> more) throw InputError(file, "not one word", "a file with the program's token alone");
  return token;
}

}  // namespace

ServerLink::ServerLink(const ServerAddress& address) : server_(address.server) {
  if (!address.tokenFile.empty()) token_ = tokenIn(address.tokenFile);
  std::shared_ptr<grpc::ChannelCredentials> credentials = grpc::InsecureChannelCredentials();
  if (!address.authority.empty()) {
    grpc::SslCredentialsOptions options;
    options.pem_root_certs = readFile(address.authority);
    credentials = grpc::SslCredentials(options);
  } else if (!isThisMachine(server_)) {
    throw InputError("--server", server_, "127.0.0.1:PORT, unix:PATH, or another machine with --ca");
  }
  grpc::ChannelArguments arguments;
  constexpr int largest = 64 << 20;
  arguments.SetMaxReceiveMessageSize(largest);
  arguments.SetInt("grpc.enable_http_proxy", 0);
  stub_ = uchilsim::v1::Worlds::NewStub(grpc::CreateCustomChannel(server_, credentials, arguments));
}

void ServerLink::identify(grpc::ClientContext& context) const {
  if (!token_.empty()) context.AddMetadata("authorization", "Bearer " + token_);
}

void ServerLink::expect(const grpc::Status& status) const {
  if (status.ok()) return;
  const std::string message = status.error_message().substr(0, status.error_message().find('\n'));
  // The library's own words are about sockets.
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE)
    throw InputError(server_ + ": no UCHILSIM answers there, or no longer (" + message + ")");
  throw InputError(server_ + ": " + message);
}

}  // namespace btr::remote
