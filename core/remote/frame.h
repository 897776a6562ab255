#pragma once
#include <functional>
#include <optional>
#include <string>

namespace btr::remote {

/// Messages between the server and the processes that work for it, over a pair of sockets: four bytes of length (this
/// machine's order), then the bytes.

inline constexpr std::size_t largestFrame = 64u << 20;

/// False if nobody listens.
bool sendFrame(int socket, const std::string& bytes);

enum class Got { frame, nothing, hungUp };
/// Waits for the next one, at most `wait_s` (negative: for ever). `cancelled`, if given, is looked at ten times a
/// second: true ends the waiting as time does. What was begun is received whole.
Got receiveFrame(int socket, std::string& bytes, double wait_s, const std::function<bool()>& cancelled = {});

}  // namespace btr::remote
