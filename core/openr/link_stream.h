#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace btr::openr {

/// Messages over a stream socket: a length of 4 bytes, little-endian, then so many bytes.
constexpr std::size_t longestMessage = 32u << 20;

enum class Passed { whole, late, gone };
using Deadline = std::chrono::steady_clock::time_point;
constexpr Deadline forEver = Deadline::max();

/// `gone` also if the other side sends what is longer. After anything but `whole` nothing more can be said: part of a
/// message may have passed.
Passed receiveMessage(int socket, std::vector<std::uint8_t>& bytes, Deadline until = forEver);
Passed sendMessage(int socket, const std::vector<std::uint8_t>& bytes, Deadline until = forEver);

}  // namespace btr::openr
