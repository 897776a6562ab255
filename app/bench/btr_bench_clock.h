#pragma once
#include <chrono>
#include <cstdio>
#include <string>

#include "core/sim/bench/bench.h"  // threadSeconds()

namespace btr::cli {

inline double wallSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// As printf, at most 200 bytes.
inline std::string printed(const char* format, auto... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace btr::cli
