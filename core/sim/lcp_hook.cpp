// Takes the place of a function inside libode: dWorldStep calls dxSolveLCP through the dynamic symbol table, and this
// library stands before libode in it. The mangled name holds all argument types; a libode without this function, or
// with other arguments, or one that is linked statically or symbolically never gets here and uses its own solver. What
// cannot be reduced goes to libode's function, and so does every reduced problem.
#include "core/sim/lcp_hook.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>

#include "core/sim/lcp_box.h"
#include "core/sim/lcp_solver.h"

struct dxWorldProcessMemArena;
using LcpFunction = void(dxWorldProcessMemArena*, unsigned, double*, double*, double*, unsigned, double*, int*);

namespace btr {
namespace {

LcpFunction* solverOfOde() {
  static const auto found =
      reinterpret_cast<LcpFunction*>(dlsym(RTLD_NEXT, "_Z10dxSolveLCPP22dxWorldProcessMemArenajPdS1_S1_jS1_Pi"));
  return found;
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

}  // namespace btr

void dxSolveLCP(dxWorldProcessMemArena* arena, unsigned n, double* a, double* bx, double* w, unsigned unbounded,
                double* loHi, int* findex);
void dxSolveLCP(dxWorldProcessMemArena* arena, unsigned n, double* a, double* bx, double* w, unsigned unbounded,
                double* loHi, int* findex) {
  btr::solve(arena, n, a, bx, w, unbounded, loHi, findex);
}
