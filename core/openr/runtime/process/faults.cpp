#include "core/openr/runtime/process/faults.h"

#include <fenv.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>

#include "core/openr/runtime/objects/system.h"

namespace btr::openr {
namespace {

FaultState state;
unsigned seenSerial = 0;
volatile int ticks = 0;
int limitTicks = 100, linkDescriptor = -1;
volatile bool faulted = false;
constexpr int ticksPerSecond = 10;

/// OrderFrame with nothing but its end, made without the heap.
void lastMessage(const char* what) {
  if (linkDescriptor < 0) return;
  static std::uint8_t bytes[1024];
  std::size_t at = 4;
  const auto number = [&](std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes[at++] = static_cast<std::uint8_t>(value >> (8 * i));
  };
  const auto text = [&](const char* value, std::size_t most) {
    const std::size_t size = strnlen(value, most);
    number(static_cast<std::uint32_t>(size));
    std::memcpy(bytes + at, value, size);
    at += size;
  };
  static const std::uint8_t magic[] = {0x62, 0x52, 0x6f, 0x31};
  std::memcpy(bytes + at, magic, 4);
  at += 4;
  number(0);                                    // joints
  number(0);                                    // lamps
  for (int i = 0; i < 4; ++i) bytes[at++] = 0;  // power, camera
  number(0);                                    // lines
  bytes[at++] = 1;                              // ended
  bytes[at++] = static_cast<std::uint8_t>(Ended::Why::crash);
  text(state.object == nullptr ? "" : state.object->name.c_str(), 200);
  text(state.method, sizeof state.method);
  text(what, 200);
  const auto size = static_cast<std::uint32_t>(at - 4);
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(size >> (8 * i));
  std::size_t sent = 0;
  while (sent < at) {
    const ssize_t count = ::write(linkDescriptor, bytes + sent, at - sent);
    if (count <= 0) break;
    sent += static_cast<std::size_t>(count);
  }
}

const char* described(int signal, const siginfo_t* info, const ucontext_t* context) {
  static char said[160];
  const auto at = [&](const char* what) {
    if (info->si_addr == nullptr)
      std::snprintf(said, sizeof said, "%s 0", what);
    else
      std::snprintf(said, sizeof said, "%s %p", what, info->si_addr);
    return said;
  };
  switch (signal) {
    case SIGSEGV: {
      const char* address = static_cast<const char*>(info->si_addr);
      const char* stack = state.object == nullptr ? nullptr : state.object->stack;
      if (stack != nullptr && address >= stack - 65536 && address < stack + 4096)
        return "its stack is full: calls that do not end, or local variables too large";
      const bool wrote = (context->uc_mcontext.gregs[REG_ERR] & 2) != 0;
      if (!wrote) return at("it read at address");
      return at(info->si_code == SEGV_ACCERR ? "it wrote to what is to be read only (a literal, a constant) at address"
                                             : "it wrote at address");
    }
    case SIGBUS:
      return at("it accessed memory that is not there at address");
    case SIGILL:
    case SIGTRAP:
      return "it ran into code that this processor does not have, or used a number at an address that is no multiple "
             "of its size";
    case SIGFPE:
      if (info->si_code == FPE_INTDIV) return "it divided an integer by zero";
      return "it computed what is no number, or made an integer of a number that is too large or none";
    case SIGABRT:
      return "the C library found its memory damaged: something was written beyond its end, or freed twice";
    default:
      std::snprintf(said, sizeof said, "signal %d", signal);
      return said;
  }
}

/// What comes after a fault takes the heap, and may wait without end for what the fault has left locked: a method that
/// stops inside malloc() never gives its lock back. So it has this long.
void limitAftermath(bool on) {
  constexpr long aftermath_s = 2;
  itimerval once{};
  once.it_value.tv_sec = on ? aftermath_s : 0;
  setitimer(ITIMER_REAL, &once, nullptr);
}

void onAftermath(int) {
  lastMessage(state.what);
  syscall(SYS_exit_group, 70);
}

[[noreturn]] void goHome() {
  limitAftermath(true);
  siglongjmp(state.home, 1);
}

void onFault(int signal, siginfo_t* info, void* context) {
  if (faulted || !state.inMethod) {
    // A second one, of what the first has left; or one between methods, of what the last method has left.
    if (!faulted) state.what = described(signal, info, static_cast<const ucontext_t*>(context));
    lastMessage(state.what);
    syscall(SYS_exit_group, 70);
  }
  faulted = true;
  state.what = described(signal, info, static_cast<const ucontext_t*>(context));
  goHome();
}

void onTick(int) {
  if (!state.inMethod || faulted) {
    ticks = 0;
    return;
  }
  if (state.serial != seenSerial) {
    seenSerial = state.serial;
    ticks = 0;
    return;
  }
  ticks = ticks + 1;
  if (ticks < limitTicks) return;
  faulted = true;
  state.endless = true;
  static char said[80];
  std::snprintf(said, sizeof said, "it has computed for %d s without coming back", limitTicks / ticksPerSecond);
  state.what = said;
  goHome();
}

}  // namespace

FaultState& faultState() { return state; }

void faultIsSettled() { limitAftermath(false); }

void watchFaults(int link, int limit_s) {
  linkDescriptor = link;
  limitTicks = limit_s * ticksPerSecond;
  const std::size_t size = 65536;
  stack_t stack{};
  stack.ss_sp = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  stack.ss_size = size;
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_sigaction = onFault;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGTRAP, SIGFPE, SIGABRT}) sigaction(signal, &action, nullptr);
  struct sigaction tick {};
  tick.sa_handler = onTick;
  tick.sa_flags = SA_ONSTACK | SA_RESTART;
  sigemptyset(&tick.sa_mask);
  sigaction(SIGPROF, &tick, nullptr);
  struct sigaction aftermath {};
  aftermath.sa_handler = onAftermath;
  aftermath.sa_flags = SA_ONSTACK;
  sigemptyset(&aftermath.sa_mask);
  sigaction(SIGALRM, &aftermath, nullptr);
  itimerval every{};
  every.it_interval.tv_usec = every.it_value.tv_usec = 1000000 / ticksPerSecond;
  setitimer(ITIMER_PROF, &every, nullptr);
}

void fail(const char* what) {
  if (!state.inMethod || faulted) {
    lastMessage(what);
    syscall(SYS_exit_group, 70);
  }
  faulted = true;
  state.what = what;
  goHome();
}

void numbersTrap() { feenableexcept(FE_INVALID); }

}  // namespace btr::openr
