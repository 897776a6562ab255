/* The C library's, and a scanf() that writes as many bytes as its variables have. */
#include_next <stdio.h>
/* after it */
#include <btr_scan.h>
