#include "core/openr/runtime/process/console.h"

#include <stdio.h>

#include <iostream>
#include <streambuf>

#include "core/openr/runtime/objects/system.h"

namespace btr::openr {
namespace {

ssize_t readConsole(void*, char* to, std::size_t size) {
  return static_cast<ssize_t>(System::instance().readTyped(to, size));
}

ssize_t writeConsole(void* object, const char* text, std::size_t size) {
  System::instance().write(static_cast<RunningObject*>(object), text, size);
  return static_cast<ssize_t>(size);
}

/// cout, cerr and clog of all objects: to the console of the one that runs.
class ConsoleOut : public std::streambuf {
  int overflow(int c) override {
    if (c == traits_type::eof()) return 0;
    const char one = static_cast<char>(c);
    xsputn(&one, 1);
    return c;
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    System& system = System::instance();
    system.write(system.current(), text, static_cast<std::size_t>(size));
    return size;
  }
};

/// cin: what stdin of the object that runs gives, one character at a time so that both see the same.
class ConsoleIn : public std::streambuf {
  int underflow() override {
    const int c = getc(stdin);
    if (c != EOF) ungetc(c, stdin);
    return c;
  }
  int uflow() override { return getc(stdin); }
  int pbackfail(int c) override { return c == traits_type::eof() ? c : ungetc(c, stdin); }
};

FILE* stream(const char* mode, cookie_io_functions_t functions, RunningObject& object) {
  FILE* file = fopencookie(&object, mode, functions);
  setvbuf(file, nullptr, _IONBF, 0);
  return file;
}

}  // namespace

void openConsole(RunningObject& object) {
  object.in = fopencookie(&object, "r", {readConsole, nullptr, nullptr, nullptr});
  object.out = stream("w", {nullptr, writeConsole, nullptr, nullptr}, object);
  object.err = stream("w", {nullptr, writeConsole, nullptr, nullptr}, object);
}

void openStreams() {
  static ConsoleOut out;
  static ConsoleIn in;
  std::cout.rdbuf(&out);
  std::cerr.rdbuf(&out);
  std::clog.rdbuf(&out);
  std::cin.rdbuf(&in);
}

}  // namespace btr::openr
