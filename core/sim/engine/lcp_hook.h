#pragma once
#include <vector>

namespace btr {

/// How ODE's complementarity problems are solved in this thread. By default they are reduced (lcp_solver.h) and what is
/// left is solved with Coulomb's law (lcp_box.h); a test may compare with ODE's own solver, a measurement may switch to
/// it.
struct LcpHook {
  bool reduce = true;    ///< false: ODE's own solver for everything
  bool coulomb = true;   ///< false: ODE's bounds of friction
  bool compare = false;  ///< solve every problem both ways, with ODE's bounds, and keep the worst difference
  long reduced = 0;      ///< problems whose unbounded rows were taken out
  long small = 0;        ///< problems that were small already
  long whole = 0;        ///< problems that were left to ODE
  double worst = 0;      ///< largest |x − x of ODE| over the largest |x|, of all compared problems

  static LcpHook& ofThisThread();
};

/// Throws std::runtime_error if this process's libode calls another solver than ours, or lacks the one that ours falls
/// back on: its trials would differ from those of other machines. Looks once, by a step of a world of its own; ODE must
/// have been started in this thread.
void requireLcpHook();

}  // namespace btr
