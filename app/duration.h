#pragma once
#include <cmath>
#include <cstdio>
#include <string>

namespace btr::cli {

/// "1:05:00".
inline std::string duration(double seconds) {
  const long s = std::lround(seconds);
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  return text;
}

}  // namespace btr::cli
