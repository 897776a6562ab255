// What ODE asks of an inertia: its inverse, which our library makes, and whether it is one.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/sim/engine/ode_body.h"
#include "core/spec/random.h"

namespace {

using namespace btr;

/// Of a body that long and thick, turned anyhow; sometimes nearly flat.
Eigen::Matrix3d anyInertia(Random& random) {
  const Eigen::Vector3d sizes(std::exp(random.normal()), std::exp(random.normal()), std::exp(4 * random.normal()));
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
  return 1e-3 * turned.toRotationMatrix() * sizes.asDiagonal() * turned.toRotationMatrix().transpose();
}

dMass massOf(const Eigen::Matrix3d& inertia) {
  dMass mass;
  dMassSetZero(&mass);
  mass.mass = 1;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) mass.I[4 * r + c] = inertia(std::max(r, c), std::min(r, c));
  return mass;
}

TEST(Inverse, IsOneAndHasTheBitsOfOdeItself) {
  void* ode = dlopen("libode.so.8", RTLD_NOW | RTLD_NOLOAD);
  ASSERT_TRUE(ode) << dlerror();
  const auto ofOde =
      reinterpret_cast<int (*)(const double*, double*, unsigned, void*)>(dlsym(ode, "_Z16dxInvertPDMatrixPKdPdjPv"));
  const auto ours = reinterpret_cast<int (*)(const double*, double*, unsigned, void*)>(
      dlsym(RTLD_DEFAULT, "_Z16dxInvertPDMatrixPKdPdjPv"));
  ASSERT_TRUE(ofOde && ours && ofOde != ours);
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const dMass mass = massOf(anyInertia(random));
    double a[12], b[12];
    std::memset(a, 0xff, sizeof a);
    ASSERT_EQ(1, ours(mass.I, a, 3, nullptr));
    ASSERT_EQ(1, ofOde(mass.I, b, 3, nullptr));
    ASSERT_EQ(0, std::memcmp(a, b, sizeof a)) << i;
    if (i >= 100) continue;
    using Rows = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>;
    const Eigen::Matrix3d product = Rows(mass.I).leftCols<3>() * Rows(a).leftCols<3>();
    EXPECT_LT((product - Eigen::Matrix3d::Identity()).norm(), 1e-6) << i;
  }
  dlclose(ode);
}

TEST(Inverse, IsRefusedWhereThereIsNone) {
  double a[12];
  const dMass flat = massOf(Eigen::Vector3d(1, 0, 1).asDiagonal()), inverted = massOf(-Eigen::Matrix3d::Identity());
  EXPECT_EQ(0, dInvertPDMatrix(flat.I, a, 3));
  EXPECT_EQ(0, dInvertPDMatrix(inverted.I, a, 3));
}

// Other sizes are ODE's.
TEST(Inverse, OfFourRowsIsOne) {
  const double four[16] = {4, 1, 0, 0, 1, 3, 1, 0, 0, 1, 2, 0, 0, 0, 0, 5};
  double inverse[16];
  ASSERT_EQ(1, dInvertPDMatrix(four, inverse, 4));
  using Square = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>;
  EXPECT_LT((Square(four) * Square(inverse) - Eigen::Matrix4d::Identity()).norm(), 1e-12);
}

TEST(Inverse, AMassIsStillCheckedUnlessItIsKnown) {
  const dMass bad = massOf(Eigen::Vector3d(1, -1, 1).asDiagonal());
  EXPECT_EQ(0, dMassCheck(&bad));
  massIsChecked() = true;
  EXPECT_EQ(1, dMassCheck(&bad));
  massIsChecked() = false;
  EXPECT_EQ(0, dMassCheck(&bad));
}

}  // namespace
