/* The robot's C library has finite() and isnan() here. */
#ifndef BTR_OPENR_IEEEFP_H
#define BTR_OPENR_IEEEFP_H
#include <math.h>
#endif
