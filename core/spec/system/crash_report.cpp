#include "core/spec/system/crash_report.h"

#include <execinfo.h>
#include <signal.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <vector>

namespace btr {
namespace {

struct Code {
  std::uintptr_t begin, end;
  char name[160];
};

std::mutex& codeGuard() {
  static std::mutex guard;
  return guard;
}

// Never destroyed: a crash may come while the program ends.
std::vector<Code>& codes() {
  static auto* all = new std::vector<Code>;
  return *all;
}

CrashTeller teller = nullptr;
constexpr std::array<int, 5> fatal{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

void onFatalSignal(int signal) {
  std::array<void*, 128> frames;
  const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
  for (int i = 0; i < count && teller; ++i) {
    const auto at = reinterpret_cast<std::uintptr_t>(frames[static_cast<std::size_t>(i)]);
    for (const Code& code : codes())
      if (code.begin <= at && at < code.end) {
        char text[224];
        std::size_t size = 0;
        const auto append = [&](const char* part) {
          while (*part && size < sizeof text) text[size++] = *part++;
        };
        const char number[] = {static_cast<char>('0' + signal / 10), static_cast<char>('0' + signal % 10), '\0'};
        append(code.name);
        append(" crashed (signal ");
        append(signal < 10 ? number + 1 : number);
        append(")");
        teller(text, size);
        i = count;
        break;
      }
  }
  // The handler is gone (SA_RESETHAND): the process ends as it would have.
  raise(signal);
}

}  // namespace

void rememberCode(const void* begin, const void* end, const std::string& name) {
  Code code{reinterpret_cast<std::uintptr_t>(begin), reinterpret_cast<std::uintptr_t>(end), {}};
  std::strncpy(code.name, name.c_str(), sizeof code.name - 1);
  const std::lock_guard lock(codeGuard());
  codes().push_back(code);
}

void tellCrashes(CrashTeller tell, bool unlessHandled) {
  // The first call loads what unwinds the stack, and the tables' vector exists: nothing of it happens in the handler.
  std::array<void*, 2> frames;
  backtrace(frames.data(), static_cast<int>(frames.size()));
  codes();
  teller = tell;
  // A stack of its own: an endless recursion leaves none. For the calling thread, which is the one that runs plugins.
  static std::array<char, 1 << 16> room;
  stack_t stack{};
  stack.ss_sp = room.data();
  stack.ss_size = room.size();
  sigaltstack(&stack, nullptr);
  for (const int signal : fatal) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (unlessHandled && before.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = onFatalSignal;
    action.sa_flags = SA_ONSTACK | SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace btr
