#pragma once
#include <setjmp.h>

#include <string>

namespace btr::openr {

struct RunningObject;

/// What a signal's handler has to know of the method that runs.
struct FaultState {
  volatile bool inMethod = false;
  RunningObject* object = nullptr;
  unsigned selector = 0;
  unsigned serial = 0;  ///< counts methods, so that the watchdog sees another one
  sigjmp_buf home;
  const char* what = "";  ///< what happened, as the handler says it: no heap, that may be what is damaged
  char method[96] = "";   ///< its name
  bool endless = false;
};
FaultState& faultState();
inline void setMethod(FaultState& state, const std::string& name) {
  state.method[name.copy(state.method, sizeof state.method - 1)] = '\0';
}

/// Crashes and endless loops of methods come back to `faultState().home`; a second crash writes a last message over
/// `link` (-1: none) and ends the process, and so does a first one if faultIsSettled() is not called within 2 s: what
/// it has left may be locked for ever. A method may use `limit_s` of the processor's time at a stretch.
void watchFaults(int link, int limit_s);

/// What was to be done about a fault is done, all but sending it. Nothing happens where there was none.
void faultIsSettled();

/// The running method has failed: as after a crash, with this text, which stays where it is.
[[noreturn]] void fail(const char* what);

/// Inside methods: what is no number, or too large for an integer, is a fault as on the robot.
void numbersTrap();

}  // namespace btr::openr
