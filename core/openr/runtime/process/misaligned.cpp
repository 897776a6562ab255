// Where a program uses a number at an address that is no multiple of its size, the compiler's check calls here: the
// robot's processor cannot do that, this one can. Names and layouts are those of GCC's -fsanitize=alignment.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "core/openr/runtime/process/faults.h"

namespace {

struct Place {
  const char* file;
  std::uint32_t line, column;
};

struct Type {
  std::uint16_t kind, info;
  char name[1];  ///< in quotes, "'int'"; longer than one
};

struct Mismatch {
  Place place;
  const Type* type;
  unsigned char logAlignment, kind;
};

struct Unreachable {
  Place place;
};

/// What the robot needs: pointers, longs and what is made of them have 4 bytes there. Only these have 8.
std::uintptr_t multipleOnTheRobot(const Mismatch& mismatch) {
  constexpr std::uintptr_t word = 4, twoWords = 8;
  const std::uintptr_t here = std::uintptr_t{1} << mismatch.logAlignment;
  if (here <= word) return here;
  const std::string_view name = mismatch.type->name;  // perhaps with "const" or "volatile" before it
  for (const char* each : {"double'", "long long int'", "long long unsigned int'"})
    if (name.ends_with(each)) return twoWords;
  return word;
}

const char* nameOf(const char* file) {
  const char* slash = std::strrchr(file, '/');
  return slash == nullptr ? file : slash + 1;
}

}  // namespace

extern "C" {

void __ubsan_handle_type_mismatch_v1(const Mismatch* mismatch, std::uintptr_t address) {
  const std::uintptr_t multiple = multipleOnTheRobot(*mismatch);
  if (address % multiple == 0) return;
  static char said[240];
  std::snprintf(said, sizeof said, "%s:%u: it used memory as %s at address %#lx, which is no multiple of %lu",
                nameOf(mismatch->place.file), mismatch->place.line, mismatch->type->name,
                static_cast<unsigned long>(address), static_cast<unsigned long>(multiple));
  btr::openr::fail(said);
}

void __ubsan_handle_builtin_unreachable(const Unreachable* where) {
  static char said[200];
  std::snprintf(said, sizeof said, "%s:%u: it came to where its source says that nobody comes",
                nameOf(where->place.file), where->place.line);
  btr::openr::fail(said);
}

}  // extern "C"
