#pragma once
#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

#include "core/spec/error.h"
#include "uchilsim.grpc.pb.h"

namespace btr::remote {

/// How a program reaches its server.
struct ServerAddress {
  std::string server;     ///< "127.0.0.1:50051", "unix:/path"
  std::string tokenFile;  ///< a file with the program's token; "" none
  std::string authority;  ///< PEM file of who signed the server's certificate; "": no TLS, for this machine only
};

/// A connection to the open interface. What goes wrong is an InputError of one sentence that begins with the server.
class ServerLink {
 public:
  using Stub = uchilsim::v1::Worlds::Stub;

  /// Does not connect yet. Throws InputError for files that cannot be read, and for another machine without TLS.
  explicit ServerLink(const ServerAddress& address);

  template <class Request, class Reply>
  Reply ask(grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Reply*), const Request& request) {
    grpc::ClientContext context;
    identify(context);
    Reply reply;
    expect((stub_.get()->*method)(&context, request, &reply));
    return reply;
  }

  Stub& stub() { return *stub_; }
  /// Says who calls.
  void identify(grpc::ClientContext& context) const;
  /// Throws InputError unless it is OK.
  void expect(const grpc::Status& status) const;

 private:
  std::string server_, token_;
  std::unique_ptr<Stub> stub_;
};

}  // namespace btr::remote
