#pragma once
#include <vector>

namespace btr {

/// How ODE's complementarity problems are solved in this thread. By default reduced problems (lcp_solver.h) stand in
/// for ODE's own solver; a test may compare both, a measurement may switch the reduction off.
struct LcpHook {
  bool reduce = true;
  bool compare = false;  ///< solve every problem by both ways and keep the worst difference
  long reduced = 0;      ///< problems that were reduced
  long whole = 0;        ///< problems that were left to ODE
  double worst = 0;      ///< largest |x − x of ODE| over the largest |x|, of all compared problems

  static LcpHook& ofThisThread();
};

}  // namespace btr
