// What programs call of the IP stack.
#include <IPAddress.h>
#include <antEnvMsg.h>
#include <arpa/inet.h>

#include <algorithm>
#include <cstring>

#include "core/openr/runtime/network/ip_stack.h"
#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/services.h"

using btr::openr::System;

antStackRef::antStackRef(const char* name_) : disp_(nullptr) {
  if (name_ != nullptr && std::strcmp(name_, "IPStack") == 0) oid.Set(reinterpret_cast<void*>(0x1));
}

antError antEnvMsg::Send(antStackRef _target, OID& _sender, int32 _selector, int _msgSize) {
  if (!_target.IsValid() || _msgSize < static_cast<int>(sizeof(antEnvMsg)) || _msgSize > 65536) return ANT_FAIL;
  constexpr std::size_t least = 2048;  // room for every kind of answer
  const std::size_t size = static_cast<std::size_t>(_msgSize);
  std::shared_ptr<void> copy(std::calloc(1, std::max(least, size)), std::free);
  std::memcpy(copy.get(), static_cast<const void*>(this), size);
  auto* message = static_cast<antEnvMsg*>(copy.get());
  message->sender = _sender;
  message->msgSize = _msgSize;
  message->invocationType = ANTENVMSG_SEND;
  const OServiceEntry entry(_sender, static_cast<Selector>(_selector));
  System& system = System::instance();
  system.services().ip().submit(message, [&system, copy, entry] { system.send(entry, copy); });
  return ANT_SUCCESS;
}

antError antEnvMsg::Call(antStackRef _dest, int _msgSize) {
  if (!_dest.IsValid()) return ANT_FAIL;
  msgSize = _msgSize;
  invocationType = ANTENVMSG_CALL;
  auto over = std::make_shared<bool>(false);
  System& system = System::instance();
  if (system.current() == nullptr || !system.current()->busy) return ANT_FAIL;  // a global constructor cannot wait
  system.services().ip().submit(this, [over] { *over = true; });
  return system.waitUntil([over] { return *over; }) ? ANT_SUCCESS : ANT_FAIL;
}

IPAddress::IPAddress(const char* str) : address_(0) {
  in_addr address{};
  if (str != nullptr && inet_pton(AF_INET, str, &address) == 1) address_ = ntohl(address.s_addr);
}

char* IPAddress::GetAsString(char* text) const {
  std::sprintf(text, "%u.%u.%u.%u", address_ >> 24, (address_ >> 16) & 255, (address_ >> 8) & 255, address_ & 255);
  return text;
}

OSTREAM& IPAddress::print(OSTREAM& os) const {
  char text[16];
  return os << GetAsString(text);
}
