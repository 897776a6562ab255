#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace btr {

/// The one random generator: xoshiro256** (Blackman and Vigna 2018), seeded through splitmix64. It is always passed in,
/// never global. Its distributions are written out here because those of the standard library differ between libraries.
/// Same seed, same sequence, on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  std::uint64_t next();                      ///< 64 random bits
  double uniform();                          ///< [0, 1), 53 bits
  double uniform(double low, double high);   ///< [low, high)
  std::uint64_t below(std::uint64_t count);  ///< 0 … count−1 without bias; count > 0
  bool chance(double probability);           ///< true with that probability
  double normal();                           ///< standard normal (Box–Muller, no value is kept between calls)

  /// A generator for an independent purpose: a function of this seed and the key alone, whatever was drawn before.
  static Random forPurpose(std::uint64_t seed, std::string_view purpose, std::uint64_t number = 0);

  std::string state() const;              ///< 64 hexadecimal digits
  void setState(std::string_view state);  ///< throws InputError if it is not such a text

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace btr
