#include "core/openr/joint_gains.h"

#include <algorithm>
#include <cmath>

#include "core/spec/error.h"

namespace btr::openr {
namespace {

// Model Information of the ERS-7 (2.2), the ERS-210 (2.3) and the ERS-220; the shifts are the same for all joints.
constexpr std::uint16_t pShift = 0x0e, iShift = 0x02, dShift = 0x0f;

struct Standard {
  const char* joint;  ///< its end: the four legs are alike
  std::uint16_t p, i, d;
};
constexpr Standard ofErs7[] = {
    {"_J1", 0x1c, 0x08, 0x01},       {"_J2", 0x14, 0x04, 0x01},       {"_J3", 0x1c, 0x08, 0x01},
    {"NECK_TILT", 0x0a, 0x04, 0x02}, {"HEAD_PAN", 0x08, 0x02, 0x04},  {"HEAD_TILT", 0x08, 0x04, 0x02},
    {"MOUTH", 0x08, 0x00, 0x04},     {"TAIL_TILT", 0x0a, 0x04, 0x04}, {"TAIL_PAN", 0x0a, 0x04, 0x04}};
constexpr Standard ofErs200[] = {
    {"_J1", 0x16, 0x04, 0x08},       {"_J2", 0x14, 0x04, 0x06},      {"_J3", 0x23, 0x04, 0x05},
    {"NECK_TILT", 0x0a, 0x08, 0x0c}, {"HEAD_PAN", 0x0d, 0x08, 0x0b}, {"HEAD_ROLL", 0x0a, 0x08, 0x0c},
    {"MOUTH", 0x0e, 0x08, 0x10},     {"TAIL_PAN", 0x0a, 0x00, 0x18}, {"TAIL_TILT", 0x07, 0x00, 0x11}};

double times(double gain, int shift, double standard, int standardShift) {
  constexpr double most = 1e6;
  if (standard == 0) return 1;
  return std::min(most, std::ldexp(gain / standard, shift - standardShift));
}

}  // namespace

JointGain standardGain(const std::string& design, const std::string& joint) {
  const auto find = [&](const auto& table) -> JointGain {
    for (const Standard& each : table)
      if (joint.ends_with(each.joint)) return {each.p, each.i, each.d, pShift, iShift, dShift};
    throw InputError("gains of an " + design, "\"" + joint + "\"", "a joint with gains");
  };
  return design == "ERS-7" ? find(ofErs7) : find(ofErs200);
}

std::array<double, 3> timesStandard(const JointGain& gain, const JointGain& standard) {
  return {times(gain.p, gain.pShift, standard.p, standard.pShift),
          times(gain.i, gain.iShift, standard.i, standard.iShift),
          times(gain.d, gain.dShift, standard.d, standard.dShift)};
}

}  // namespace btr::openr
