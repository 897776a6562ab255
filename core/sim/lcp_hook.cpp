// Takes the place of a function inside libode: dWorldStep calls dxSolveLCP through the dynamic symbol table, and this
// library stands before libode in it. The mangled name holds all argument types; a libode without this function, or
// with other arguments, or one that is linked statically or symbolically never gets here and uses its own solver. What
// cannot be reduced goes to libode's function, and so does every reduced problem.
#include "core/sim/lcp_hook.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

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

LcpReducer& reducer() {
  thread_local LcpReducer one;
  return one;
}

void solve(dxWorldProcessMemArena* arena, unsigned n, double* a, double* bx, double* w, unsigned unbounded,
           double* loHi, int* findex) {
  LcpHook& hook = LcpHook::ofThisThread();
  const LcpProblem problem{n, n > 1 ? (n + 3) / 4 * 4 : n, a, bx, loHi, findex};
  if (!hook.reduce || w || !reducer().reduce(problem)) {
    ++hook.whole;
    return solverOfOde()(arena, n, a, bx, w, unbounded, loHi, findex);
  }
  ++hook.reduced;
  const LcpProblem& small = reducer().small();
  if (small.n > 0)
    solverOfOde()(arena, small.n, reducer().smallA(), small.bx, nullptr, 0, reducer().smallLoHi(),
                  reducer().smallFindex());
  reducer().expand(problem);
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
