#pragma once
#include <functional>
#include <optional>
#include <string>

namespace btr::remote {

/// Messages between the server and the processes that work for it, over a pair of sockets: four bytes of length (this
/// machine's order), then the bytes. One of no bytes is no message: whoever works on an answer says with it that he is
/// still at it.

inline constexpr std::size_t largestFrame = 64u << 20;

enum class Sent { whole, nothing, hungUp };
/// Waits until all of it is taken, at most `wait_s` (negative: for ever). `cancelled`, if given, is looked at ten times
/// a second. After anything but `whole` the other end cannot be talked to any more: part of the message may be there.
Sent sendFrame(int socket, const std::string& bytes, double wait_s = -1, const std::function<bool()>& cancelled = {});
/// The same for bytes without a length.
Sent sendBytes(int socket, const std::string& bytes, double wait_s, const std::function<bool()>& cancelled = {});

enum class Got { frame, nothing, hungUp };
/// Waits for the next one, at most `wait_s` for its first byte and `rest_s` for the others (negative: for ever).
/// `cancelled`, if given, is looked at ten times a second: true ends the waiting as time does. After `nothing` of a
/// message that was begun the other end cannot be listened to any more.
Got receiveFrame(int socket, std::string& bytes, double wait_s, const std::function<bool()>& cancelled = {},
                 double rest_s = -1);

}  // namespace btr::remote
