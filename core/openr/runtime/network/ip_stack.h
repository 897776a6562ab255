#pragma once
#include <EndpointTypes.h>
#include <IPAddress.h>
#include <antEnvMsg.h>

#include <deque>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/openr/runtime/network/network_settings.h"
#include "core/openr/runtime/objects/system.h"

class UDPEndpointSendMsg;
class UDPEndpointReceiveMsg;

namespace btr::openr {

/// The robot's IP stack on this computer's loopback. A port of the robot's is a port here: the same if it is free and
/// needs no rights (else 10000 more, else any), and said on the console.
class IpStack {
 public:
  explicit IpStack(System& system);
  ~IpStack();

  /// The operation of `message` begins. `done` is called, perhaps at once, with its answer in `message`.
  void submit(antEnvMsg* message, std::function<void()> done);
  /// Goes on with what waits.
  enum class Polled { all, listening };
  void poll(Polled polled = Polled::all);
  void closeAll();
  const NetworkSettings& settings() const { return settings_; }

 private:
  struct Endpoint {
    int type = 0;
    int socket = -1;
    int ear = -1;  ///< hears what is sent to everybody
    bool connected = false, closed = false;
    Port bound = 0;                ///< of the robot
    int closes = 0;                ///< how often it was closed
    std::vector<IPAddress> found;  ///< by the last question for a name
  };
  struct Listener {
    int socket = -1;
    Port actual = 0;
  };
  struct Operation {
    antEnvMsg* message;
    std::function<void()> done;
    uint32 endpoint;
    int received = 0, sent = 0;
    bool begun = false;
    int closes = 0;  ///< of its endpoint when it began
  };

  bool stackOperation(antEnvMsg* message);
  /// Whether it has ended.
  bool tcp(Operation& operation, Endpoint& endpoint);
  bool udp(Operation& operation, Endpoint& endpoint);
  bool sendDatagram(UDPEndpointSendMsg& send, Endpoint& endpoint);
  bool receiveDatagram(UDPEndpointReceiveMsg& receive, Endpoint& endpoint);
  void rememberOwnWord(const UDPEndpointSendMsg& send);
  bool isOwnWord(Port port, const byte* begin, std::size_t size);
  bool isOwnName(std::string name) const;
  void dns(antEnvMsg* message, Endpoint& endpoint);
  /// Shared buffers, not beyond their end; other memory passes, too, which is said.
  bool mayUse(const void* address, int size);
  Listener* listener(Port port);
  static void beginConnect(Endpoint& endpoint, Port actual);
  int bindDatagram(Endpoint& endpoint, Port port);
  Port actualOf(Port port, bool tcp) const;
  void tell(const char* kind, Port port, Port actual);
  bool busy(const Endpoint& endpoint, uint32 id, int operation) const;
  void closeEndpoint(Endpoint& endpoint);

  System& system_;
  std::map<uint32, Endpoint> endpoints_;
  uint32 nextEndpoint_ = 1;
  std::map<Port, Listener> listeners_;
  std::map<Port, Port> datagramPorts_;
  std::deque<std::pair<Port, std::string>> ownWords_;  ///< to everybody at a port at which this robot hears itself
  std::set<std::pair<Port, Port>> told_;               ///< ports of datagrams that were said, and their twins
  std::map<const byte*, int> buffers_;
  bool toldOwnMemory_ = false;
  std::list<Operation> operations_;
  NetworkSettings settings_;
};

}  // namespace btr::openr
