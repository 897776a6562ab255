#include "core/sim/engine/ode_session.h"

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <mutex>

#include "core/sim/engine/lcp_hook.h"

namespace btr {
namespace {

std::atomic<bool>& sessionLives() {
  static std::atomic<bool> lives{false};
  return lives;
}

// ODE calls exit() or abort() when these return, so they leave by an exception. Its frames carry unwind tables.
[[noreturn]] void raise(int number, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  throw OdeFailure("ODE error " + std::to_string(number) + ": " + text);
}

// Notes of the solver ("LCP internal error, s <= 0") are followed by its own way out; the state is checked after each
// step.
void ignore(int, const char*, va_list) {}

void startOde() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetErrorHandler(raise);
    dSetDebugHandler(raise);
    dSetMessageHandler(ignore);
  });
  thread_local const bool allocated = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  if (!allocated) throw std::runtime_error("ODE has no memory for this thread");
  requireLcpHook();
}

}  // namespace

void requireOde() { startOde(); }

OdeSession::OdeSession(std::uint64_t seed) {
  startOde();
  if (sessionLives().exchange(true)) throw std::logic_error("only one World may exist in a process at a time");
  dRandSetSeed(static_cast<unsigned long>(seed & 0xffffffffu));
  world_ = dWorldCreate();
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);
  dWorldSetAutoDisableFlag(world_, 0);
  contacts_ = dJointGroupCreate(0);
}

OdeSession::~OdeSession() {
  dJointGroupDestroy(contacts_);
  dWorldDestroy(world_);
  // After an error the threading object still holds the unfinished step's calls: it is left alone rather than freed.
  if (!broken_) dThreadingFreeImplementation(threading_);
  sessionLives() = false;
}

void OdeSession::step(double duration) {
  broken_ = true;
  dWorldStep(world_, duration);
  broken_ = false;
}

}  // namespace btr
