#include "core/spec/random.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "core/spec/error.h"
#include "core/spec/require.h"

namespace btr {
namespace {

/// splitmix64 (Steele, Lea, Flood 2014): spreads a seed over the whole state.
std::uint64_t splitmix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// FNV-1a over the bytes of a text.
std::uint64_t hashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
  return hash;
}

}  // namespace

Random::Random(std::uint64_t seed) {
  for (std::uint64_t& word : state_) word = splitmix(seed);
}

std::uint64_t Random::next() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::uint64_t Random::below(std::uint64_t count) {
  require(count > 0, "Random::below() of more than 0");
  // The first 2^64 mod count numbers would make small results likelier: draw again.
  const std::uint64_t rejected = (0 - count) % count;
  std::uint64_t bits = next();
  while (bits < rejected) bits = next();
  return bits % count;
}

bool Random::chance(double probability) { return uniform() < probability; }

double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

Random Random::forPurpose(std::uint64_t seed, std::string_view purpose, std::uint64_t number) {
  std::uint64_t key = seed;
  key = splitmix(key) ^ hashOf(purpose);
  key = splitmix(key) ^ number;
  return Random(splitmix(key));
}

std::string Random::state() const {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint64_t word : state_)
    for (int shift = 60; shift >= 0; shift -= 4) text += digits[(word >> shift) & 15];
  return text;
}

void Random::setState(std::string_view state) {
  const auto refuse = [&] {
    throw InputError("random state", "\"" + std::string(state.substr(0, 80)) + "\"",
                     "64 hexadecimal digits, not all 0");
  };
  if (state.size() != 64) refuse();
  std::array<std::uint64_t, 4> words{};
  for (std::size_t i = 0; i < state.size(); ++i) {
    const char digit = state[i];
    const bool decimal = digit >= '0' && digit <= '9', letter = digit >= 'a' && digit <= 'f';
    if (!decimal && !letter) refuse();
    words[i / 16] = words[i / 16] << 4 | static_cast<std::uint64_t>(decimal ? digit - '0' : digit - 'a' + 10);
  }
  if (words == std::array<std::uint64_t, 4>{}) refuse();
  state_ = words;
}

}  // namespace btr
