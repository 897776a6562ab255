/* As the robot's C library calls it. */
#ifndef BTR_OPENR_MACHINE_ENDIAN_H
#define BTR_OPENR_MACHINE_ENDIAN_H
#include <endian.h>
#endif
