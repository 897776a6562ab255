/* As the robot's C library calls it. */
#ifndef BTR_OPENR_MACHINE_TYPES_H
#define BTR_OPENR_MACHINE_TYPES_H
#include <sys/types.h>
#endif
