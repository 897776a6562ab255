// Takes the place of two functions inside libode, as lcp_hook.cpp does: what dBodySetMass() asks of an inertia that
// changes with every step. The inverse has the bits of libode's own: the same operations in the same order, but for a
// matrix of three rows alone, written out. Without effect (another libode) everything is as libode has it.
#include <dlfcn.h>
#include <ode/ode.h>

#include <cmath>

#include "core/sim/engine/ode_body.h"

namespace btr {
namespace {

using InvertFunction = int(const double*, double*, unsigned, void*);
using CheckFunction = int(const dMass*);

/// A matrix of ODE: three rows, four numbers apart; its lower triangle is read. False if it is not positive definite;
/// `inverse` was not touched then.
bool invertThree(const double* a, double* inverse) {
  double l[3][3], recip[3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      double sum = a[4 * i + j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = sum * recip[j];
    }
    double sum = a[4 * i + i];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * l[i][k];
    if (!(sum > 0)) return false;
    l[i][i] = std::sqrt(sum);
    recip[i] = 1 / l[i][i];
  }
  // Three columns of the identity side by side.
  double x[3][3];
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k < i; ++k) sum += l[i][k] * x[k][c];
      x[i][c] = ((i == c ? 1 : 0) - sum) / l[i][i];
    }
  for (int i = 3; i-- > 0;)
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = i + 1; k < 3; ++k) sum += l[k][i] * x[k][c];
      x[i][c] = (x[i][c] - sum) / l[i][i];
    }
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) inverse[4 * i + c] = x[i][c];
    inverse[4 * i + 3] = 0;
  }
  return true;
}

}  // namespace

bool& massIsChecked() {
  thread_local bool checked = false;
  return checked;
}

}  // namespace btr

int dxInvertPDMatrix(const double* a, double* inverse, unsigned n, void* scratch);
int dxInvertPDMatrix(const double* a, double* inverse, unsigned n, void* scratch) {
  if (n == 3 && btr::invertThree(a, inverse)) return 1;
  static const auto ofOde = reinterpret_cast<btr::InvertFunction*>(dlsym(RTLD_NEXT, "_Z16dxInvertPDMatrixPKdPdjPv"));
  return ofOde(a, inverse, n, scratch);
}

int dMassCheck(const dMass* mass) {
  if (btr::massIsChecked()) return 1;
  static const auto ofOde = reinterpret_cast<btr::CheckFunction*>(dlsym(RTLD_NEXT, "dMassCheck"));
  return ofOde(mass);
}
