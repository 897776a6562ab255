#ifndef SUM_H
#define SUM_H
#include <Types.h>
#ifdef __cplusplus
extern "C"
#endif
    long
    sum_of(const longword* values, int count);
#endif
