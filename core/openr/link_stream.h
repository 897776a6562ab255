#pragma once
#include <cstdint>
#include <vector>

namespace btr::openr {

/// Messages over a stream socket: a length of 4 bytes, little-endian, then so many bytes.
constexpr std::size_t longestMessage = 32u << 20;

/// False if the other side is gone or sends what is longer.
bool receiveMessage(int socket, std::vector<std::uint8_t>& bytes);
bool sendMessage(int socket, const std::vector<std::uint8_t>& bytes);

}  // namespace btr::openr
