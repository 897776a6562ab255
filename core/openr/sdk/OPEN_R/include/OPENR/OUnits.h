// Degrees, radians, and the millionths in which OPEN-R counts.
#ifndef BTR_OPENR_OUNITS_H
#define BTR_OPENR_OUNITS_H

#include <Types.h>

const slongword oradiansPI = 3141592;
const slongword oradiansPI_2 = 1570796;
const slongword oradiansPI_4 = 785398;

inline double degrees(double radians_) { return radians_ * 180.0 / 3.14159265358979323846; }
inline double radians(double degrees_) { return degrees_ * 3.14159265358979323846 / 180.0; }
/// Cut, not rounded.
inline slongword micro(double value) { return static_cast<slongword>(value * 1000000.0); }
/// Degrees to µrad.
inline slongword oradians(double degrees_) { return micro(radians(degrees_)); }

#endif
