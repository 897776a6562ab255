// Takes the place of a function inside libode: dWorldStep calls dxSolveLCP through the dynamic symbol table, and this
// library stands before libode in it. The mangled name holds all argument types; a libode without this function, or
// with other arguments, or one that is linked statically or symbolically never gets here and uses its own solver. What
// cannot be reduced goes to libode's function, and so does every reduced problem.
#include "core/sim/engine/lcp_hook.h"

#include <dlfcn.h>
#include <ode/ode.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/sim/engine/lcp_box.h"
#include "core/sim/engine/lcp_solver.h"

struct dxWorldProcessMemArena;
using LcpFunction = void(dxWorldProcessMemArena*, unsigned, double*, double*, double*, unsigned, double*, int*);

namespace btr {
namespace {

LcpFunction* solverOfOde() {
  static const auto found =
      reinterpret_cast<LcpFunction*>(dlsym(RTLD_NEXT, "_Z10dxSolveLCPP22dxWorldProcessMemArenajPdS1_S1_jS1_Pi"));
  return found;
}

/// Problems that came here from one step of a wheel with a motor, or −1 where libode's own solver is not found.
long problemsOfAStep() {
  if (!solverOfOde()) return -1;
  const LcpHook& hook = LcpHook::ofThisThread();
  const long before = hook.reduced + hook.small + hook.whole;
  const dWorldID world = dWorldCreate();
  const dBodyID wheel = dBodyCreate(world);
  const dJointID axle = dJointCreateHinge(world, nullptr);
  dJointAttach(axle, wheel, nullptr);
  dJointSetHingeAxis(axle, 0, 0, 1);
  dJointSetHingeParam(axle, dParamVel, 1);
  dJointSetHingeParam(axle, dParamFMax, 1);
  dWorldStep(world, 0.001);
  dWorldDestroy(world);
  return hook.reduced + hook.small + hook.whole - before;
}

struct Memory {
  LcpReducer reducer;
  BoxSolver box;
};

/// False if the problem is to be left to ODE; nothing was changed then except x.
bool solveHere(const LcpProblem& problem, LcpHook& hook) {
  thread_local Memory memory;
  const bool coulomb = hook.coulomb && !hook.compare;
  if (memory.reducer.reduce(problem)) {
    const LcpProblem& small = memory.reducer.small();
    if (small.n > 0 && !memory.box.solve(small, coulomb)) return false;
    memory.reducer.expand(problem);
    ++hook.reduced;
    return true;
  }
  if (!memory.box.solve(problem, coulomb)) return false;
  ++hook.small;
  return true;
}

void solve(dxWorldProcessMemArena* arena, unsigned n, double* a, double* bx, double* w, unsigned unbounded,
           double* loHi, int* findex) {
  LcpHook& hook = LcpHook::ofThisThread();
  const LcpProblem problem{n, n > 1 ? (n + 3) / 4 * 4 : n, a, bx, loHi, findex};
  if (!hook.reduce || w || !solveHere(problem, hook)) {
    ++hook.whole;
    solverOfOde()(arena, n, a, bx, w, unbounded, loHi, findex);
    return;
  }
  if (!hook.compare) return;
  std::vector<double> mine(n);
  double largest = 1e-12, apart = 0;
  for (unsigned i = 0; i < n; ++i) mine[i] = bx[2 * i + 1];
  solverOfOde()(arena, n, a, bx, w, unbounded, loHi, findex);
  for (unsigned i = 0; i < n; ++i) {
    largest = std::max(largest, std::abs(bx[2 * i + 1]));
    apart = std::max(apart, std::abs(bx[2 * i + 1] - mine[i]));
  }
  hook.worst = std::max(hook.worst, apart / largest);
}

}  // namespace

LcpHook& LcpHook::ofThisThread() {
  thread_local LcpHook hook;
  return hook;
}

void requireLcpHook() {
  static const long problems = problemsOfAStep();
  if (problems > 0) return;
  throw std::runtime_error(problems < 0
                               ? "this libode has no dxSolveLCP to fall back on; install Debian's libode8 (0.16.2)"
                               : "this libode does not call UCHILSIM's constraint solver (a libode that was preloaded, "
                                 "or linked statically?): "
                                 "trials would not be the same, bit for bit, as on other machines");
}

}  // namespace btr

void dxSolveLCP(dxWorldProcessMemArena* arena, unsigned n, double* a, double* bx, double* w, unsigned unbounded,
                double* loHi, int* findex);
void dxSolveLCP(dxWorldProcessMemArena* arena, unsigned n, double* a, double* bx, double* w, unsigned unbounded,
                double* loHi, int* findex) {
  btr::solve(arena, n, a, bx, w, unbounded, loHi, findex);
}
