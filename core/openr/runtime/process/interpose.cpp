// The C library's functions that a robot has in another way: files are the stick's, time is simulated, exit() ends a
// method, and there are no other programs. They serve methods only; everything else in this process gets the C
// library's own.
#include <apsys.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/times.h>
#include <time.h>
#include <unistd.h>

#include <cstring>
#include <string>

#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/services.h"

using btr::openr::OwnAccess;
using btr::openr::Services;
using btr::openr::System;
using btr::openr::theSystemIsThere;

namespace {

bool inMethod() { return theSystemIsThere() && System::instance().current() != nullptr && !OwnAccess::any(); }

template <class F>
F own(const char* name) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

/// Where `path` stands on this computer; nullptr with errno set if it is not on the stick.
class StickPath {
 public:
  explicit StickPath(const char* path) {
    const OwnAccess own;
    if (path != nullptr) text_ = btr::openr::onStick(System::instance().stick, path);
    if (!text_.empty()) return;
    if (path != nullptr && path[0] != '\0')
      System::instance().sayOnce(
          path, '"' + std::string(path) + "\" is not on the robot: its files are those below /MS, without \"..\"");
    errno = ENOENT;
  }
  const char* get() const { return text_.empty() ? nullptr : text_.c_str(); }

 private:
  std::string text_;
};

std::int64_t now_us() { return Services::epoch_s * 1000000 + System::instance().readClock_us(); }

/// Waits in simulated time.
void rest(std::int64_t us) {
  System& system = System::instance();
  const std::int64_t until = system.time_us() + us;
  system.waitUntil([&system, until] { return system.time_us() >= until; });
}

}  // namespace

extern "C" {

#define ON_STICK(type, name, failed, parameters, path, arguments) \
  type name parameters {                                          \
    static const auto real = own<type(*) parameters>(#name);      \
    if (!inMethod()) return real arguments;                       \
    const StickPath mapped(path);                                 \
    if (mapped.get() == nullptr) return failed;                   \
    path = mapped.get();                                          \
    return real arguments;                                        \
  }

ON_STICK(FILE*, fopen, nullptr, (const char* path, const char* mode), path, (path, mode))
ON_STICK(FILE*, fopen64, nullptr, (const char* path, const char* mode), path, (path, mode))
ON_STICK(FILE*, freopen, nullptr, (const char* path, const char* mode, FILE* file), path, (path, mode, file))
ON_STICK(FILE*, freopen64, nullptr, (const char* path, const char* mode, FILE* file), path, (path, mode, file))
ON_STICK(int, creat, -1, (const char* path, mode_t mode), path, (path, mode))
ON_STICK(int, creat64, -1, (const char* path, mode_t mode), path, (path, mode))
ON_STICK(int, stat, -1, (const char* path, struct stat* to), path, (path, to))
ON_STICK(int, stat64, -1, (const char* path, struct stat64* to), path, (path, to))
ON_STICK(int, lstat, -1, (const char* path, struct stat* to), path, (path, to))
ON_STICK(int, lstat64, -1, (const char* path, struct stat64* to), path, (path, to))
ON_STICK(int, access, -1, (const char* path, int mode), path, (path, mode))
ON_STICK(int, mkdir, -1, (const char* path, mode_t mode), path, (path, mode))
ON_STICK(int, rmdir, -1, (const char* path), path, (path))
ON_STICK(int, unlink, -1, (const char* path), path, (path))
ON_STICK(int, remove, -1, (const char* path), path, (path))
ON_STICK(int, truncate, -1, (const char* path, off_t size), path, (path, size))
ON_STICK(int, truncate64, -1, (const char* path, off64_t size), path, (path, size))
ON_STICK(int, chmod, -1, (const char* path, mode_t mode), path, (path, mode))

int open(const char* path, int flags, ...) {
  static const auto real = own<int (*)(const char*, int, ...)>("open");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  if (!inMethod()) return real(path, flags, mode);
  const StickPath mapped(path);
  return mapped.get() == nullptr ? -1 : real(mapped.get(), flags | O_CLOEXEC, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open(path, flags | O_LARGEFILE, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  static const auto real = own<int (*)(int, const char*, int, ...)>("openat");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return inMethod() ? open(path, flags, mode) : real(folder, path, flags, mode);
}

int rename(const char* from, const char* to) {
  static const auto real = own<int (*)(const char*, const char*)>("rename");
  if (!inMethod()) return real(from, to);
  const StickPath source(from), target(to);
  return source.get() == nullptr || target.get() == nullptr ? -1 : real(source.get(), target.get());
}

int link(const char* from, const char* to) {
  static const auto real = own<int (*)(const char*, const char*)>("link");
  if (!inMethod()) return real(from, to);
  errno = EPERM;
  return -1;
}

int symlink(const char* from, const char* to) {
  static const auto real = own<int (*)(const char*, const char*)>("symlink");
  if (!inMethod()) return real(from, to);
  errno = EPERM;
  return -1;
}

int chdir(const char* path) {
  static const auto real = own<int (*)(const char*)>("chdir");
  if (!inMethod()) return real(path);
  errno = ENOSYS;
  return -1;
}

// ---- other programs ---------------------------------------------------------------------------------------------

int system(const char* command) {
  static const auto real = own<int (*)(const char*)>("system");
  if (!inMethod()) return real(command);
  errno = ENOSYS;
  return command == nullptr ? 0 : -1;
}

FILE* popen(const char* command, const char* mode) {
  static const auto real = own<FILE* (*)(const char*, const char*)>("popen");
  if (!inMethod()) return real(command, mode);
  errno = ENOSYS;
  return nullptr;
}

pid_t fork() {
  static const auto real = own<pid_t (*)()>("fork");
  if (!inMethod()) return real();
  errno = ENOSYS;
  return -1;
}

int execve(const char* path, char* const arguments[], char* const environment[]) {
  static const auto real = own<int (*)(const char*, char* const[], char* const[])>("execve");
  if (!inMethod()) return real(path, arguments, environment);
  errno = ENOSYS;
  return -1;
}

// ---- ends -------------------------------------------------------------------------------------------------------

void exit(int status) {
  static const auto real = own<void (*)(int)>("exit");
  if (inMethod()) System::instance().endMethod();
  real(status);
  __builtin_unreachable();
}

void _exit(int status) {
  static const auto real = own<void (*)(int)>("_exit");
  if (inMethod()) System::instance().endMethod();
  real(status);
  __builtin_unreachable();
}

void abort() {
  static const auto real = own<void (*)()>("abort");
  if (inMethod()) System::instance().endMethod();
  real();
  __builtin_unreachable();
}

[[noreturn]] void __assert_fail(const char* what, const char* file, unsigned line, const char* function) {
  static const auto real = own<void (*)(const char*, const char*, unsigned, const char*)>("__assert_fail");
  if (inMethod()) {
    const std::string text = std::string(file) + ":" + std::to_string(line) + ": assertion \"" + what + "\" failed\n";
    System& system = System::instance();
    system.write(system.current(), text.data(), text.size());
    system.endMethod();
  }
  real(what, file, line, function);
  __builtin_unreachable();
}

// ---- console ----------------------------------------------------------------------------------------------------

char* gets(char* line) {
  std::size_t size = 0;
  for (int c = getc(stdin); c != '\n'; c = getc(stdin)) {
    if (c == EOF) {
      if (size == 0) return nullptr;
      break;
    }
    line[size++] = static_cast<char>(c);
  }
  line[size] = '\0';
  return line;
}

ssize_t read(int file, void* to, size_t size) {
  static const auto real = own<ssize_t (*)(int, void*, size_t)>("read");
  if (file != STDIN_FILENO || !inMethod()) return real(file, to, size);
  return static_cast<ssize_t>(System::instance().readTyped(static_cast<char*>(to), size));
}

ssize_t write(int file, const void* from, size_t size) {
  static const auto real = own<ssize_t (*)(int, const void*, size_t)>("write");
  if ((file != STDOUT_FILENO && file != STDERR_FILENO) || !inMethod()) return real(file, from, size);
  System& system = System::instance();
  system.write(system.current(), static_cast<const char*>(from), size);
  return static_cast<ssize_t>(size);
}

// ---- time -------------------------------------------------------------------------------------------------------

time_t time(time_t* to) noexcept {
  static const auto real = own<time_t (*)(time_t*)>("time");
  if (!inMethod()) return real(to);
  const time_t now = now_us() / 1000000;
  if (to != nullptr) *to = now;
  return now;
}

int gettimeofday(struct timeval* to, void* zone) noexcept {
  static const auto real = own<int (*)(struct timeval*, void*)>("gettimeofday");
  if (!inMethod()) return real(to, zone);
  const std::int64_t us = now_us();
  to->tv_sec = us / 1000000;
  to->tv_usec = us % 1000000;
  return 0;
}

int clock_gettime(clockid_t clock, struct timespec* to) noexcept {
  static const auto real = own<int (*)(clockid_t, struct timespec*)>("clock_gettime");
  if (!inMethod()) return real(clock, to);
  const std::int64_t us = clock == CLOCK_REALTIME ? now_us() : System::instance().readClock_us();
  to->tv_sec = us / 1000000;
  to->tv_nsec = us % 1000000 * 1000;
  return 0;
}

clock_t clock() noexcept {
  static const auto real = own<clock_t (*)()>("clock");
  return inMethod() ? System::instance().readClock_us() : real();
}

unsigned sleep(unsigned seconds) {
  static const auto real = own<unsigned (*)(unsigned)>("sleep");
  if (!inMethod()) return real(seconds);
  rest(std::int64_t{seconds} * 1000000);
  return 0;
}

int usleep(useconds_t us) {
  static const auto real = own<int (*)(useconds_t)>("usleep");
  if (!inMethod()) return real(us);
  rest(us);
  return 0;
}

int nanosleep(const struct timespec* wanted, struct timespec* left) {
  static const auto real = own<int (*)(const struct timespec*, struct timespec*)>("nanosleep");
  if (!inMethod()) return real(wanted, left);
  rest(std::int64_t{wanted->tv_sec} * 1000000 + wanted->tv_nsec / 1000);
  return 0;
}

}  // extern "C"

sError Wait(longlong nanoseconds) {
  if (nanoseconds < 0) return sINVALID_ARG;
  rest(nanoseconds / 1000);
  return sSUCCESS;
}
