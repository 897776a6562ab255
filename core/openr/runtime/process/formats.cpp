// printf() and its kin. On the robot a `long` has 32 bits and programs print a longword by "%ld"; here it has 64, and
// what stands above the 32 bits that were passed is nothing of the program's. So "%ld" prints 32 bits, as there, and
// strtol() and its kin end where those of 32 bits do.
#include "core/openr/runtime/process/formats.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>

#include <cstdint>
#include <cstring>

#include "core/openr/runtime/objects/system.h"

namespace btr::openr {

std::string robotFormat(const char* format) {
  std::string text;
  for (const char* at = format; *at != '\0'; ++at) {
    text += *at;
    if (*at != '%') continue;
    if (at[1] == '%') {
      text += *++at;
      continue;
    }
    const char* next = at + 1;
    next += std::strspn(next, "#0- +'0123456789.*$");
    text.append(at + 1, next);
    const bool isLong = next[0] == 'l' && next[1] != '\0' && std::strchr("diouxX", next[1]) != nullptr;
    at = isLong ? next : next - 1;
  }
  return text;
}

}  // namespace btr::openr

namespace {

using btr::openr::robotFormat;

bool inMethod() {
  return btr::openr::theSystemIsThere() && btr::openr::System::instance().current() != nullptr &&
         !btr::openr::OwnAccess::any();
}

template <class F>
F own(const char* name) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int vfprintf(FILE* to, const char* format, va_list arguments) {
  static const auto real = own<int (*)(FILE*, const char*, va_list)>("vfprintf");
  return inMethod() ? real(to, robotFormat(format).c_str(), arguments) : real(to, format, arguments);
}

int vsnprintf(char* to, size_t size, const char* format, va_list arguments) noexcept {
  static const auto real = own<int (*)(char*, size_t, const char*, va_list)>("vsnprintf");
  return inMethod() ? real(to, size, robotFormat(format).c_str(), arguments) : real(to, size, format, arguments);
}

int vsprintf(char* to, const char* format, va_list arguments) noexcept {
  static const auto real = own<int (*)(char*, const char*, va_list)>("vsprintf");
  return inMethod() ? real(to, robotFormat(format).c_str(), arguments) : real(to, format, arguments);
}

// The C library's headers define these two inline; theirs are left alone, and programs find ours.
int robotVprintf(const char* format, va_list arguments) __asm__("vprintf");
int robotVprintf(const char* format, va_list arguments) { return vfprintf(stdout, format, arguments); }

long robotAtol(const char* text) noexcept __asm__("atol");
long robotAtol(const char* text) noexcept { return strtol(text, nullptr, 10); }

#define BTR_OPENR_FORMATTED(call) \
  va_list arguments;              \
  va_start(arguments, format);    \
  const int count = call;         \
  va_end(arguments);              \
  return count

int printf(const char* format, ...) { BTR_OPENR_FORMATTED(vfprintf(stdout, format, arguments)); }
int fprintf(FILE* to, const char* format, ...) { BTR_OPENR_FORMATTED(vfprintf(to, format, arguments)); }
int sprintf(char* to, const char* format, ...) noexcept { BTR_OPENR_FORMATTED(vsprintf(to, format, arguments)); }
int snprintf(char* to, size_t size, const char* format, ...) noexcept {
  BTR_OPENR_FORMATTED(vsnprintf(to, size, format, arguments));
}

long strtol(const char* text, char** end, int base) noexcept {
  static const auto real = own<long (*)(const char*, char**, int)>("strtol");
  const long value = real(text, end, base);
  if (!inMethod() || (value >= INT32_MIN && value <= INT32_MAX)) return value;
  errno = ERANGE;
  return value < 0 ? INT32_MIN : INT32_MAX;
}

unsigned long strtoul(const char* text, char** end, int base) noexcept {
  static const auto real = own<unsigned long (*)(const char*, char**, int)>("strtoul");
  const unsigned long value = real(text, end, base);
  if (!inMethod()) return value;
  const unsigned long size = static_cast<long>(value) < 0 ? 0 - value : value;  // "-1" is the largest one
  if (size <= UINT32_MAX) return value & UINT32_MAX;
  errno = ERANGE;
  return UINT32_MAX;
}

}  // extern "C"
