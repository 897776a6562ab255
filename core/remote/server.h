#pragma once
#include <memory>
#include <string>

#include "core/remote/gate.h"
#include "core/remote/switchboard.h"

namespace btr::remote {

/// The open interface: uchilsim.proto over gRPC. The file is its documentation.
class Server {
 public:
  struct Options {
    std::string address = "127.0.0.1";  ///< "" for none, with a Unix socket
    int port = 0;                       ///< 0: any that is free
    std::string unixPath{};             ///< also, or instead, a socket that only this user may open
    std::string certificate{}, key{};   ///< PEM files; without them nothing is encrypted
    Gate::Options gate{};
    std::size_t largestMessage = 4u << 20;
    int mostStreams = 0;       ///< at once, of one client half of them; 0: enough for all worlds
    int mostEvaluations = 32;  ///< that compute or wait at once, of one client half of them
  };

  /// Begins to listen. The switchboard must outlive it. Throws InputError for an address that cannot be had, and for
  /// one beyond this machine without TLS and tokens.
  Server(const Options& options, Switchboard& switchboard);
  /// Calls that are being answered are cancelled.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;           ///< 0 without an address
  std::string where() const;  ///< "127.0.0.1:50051 and unix:/run/user/1000/uchilsim"
  bool isToEnd() const;       ///< an administrator asked for it

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::remote
