/* The C library's, and for C++ a scanf() that writes as many bytes as its variables have. */
#include_next <stdio.h>
#ifdef __cplusplus
#include <btr_scan.h>
#endif
