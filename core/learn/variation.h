#pragma once
#include <cstddef>
#include <string>

#include "core/spec/random.h"

namespace btr {

/// Two places between bits of a string, 1 ≤ first < second ≤ length − 1: the bits first … second − 1 lie between them.
struct Cuts {
  std::size_t first = 0, second = 0;
  bool operator==(const Cuts&) const = default;
};

/// Two different cuts, every pair equally likely, inside genes as well as between them. length ≥ 3.
Cuts drawCuts(std::size_t length, Random& random);

/// Two-point crossover: exchanges the bits between the cuts of two strings of equal length.
void exchange(std::string& one, std::string& other, const Cuts& cuts);

/// Inverts each bit ('0' or '1') with this probability, independently.
void mutate(std::string& bits, double probability, Random& random);

}  // namespace btr
