// Knows the C library alone, and still reads 32 bits by "%ld".
extern "C" {
#include <stdio.h>
}
#include "deeper.h"
int Deeper::twice(int value) {
  unsigned int read[3] = {0, 0, 5};
  sscanf("2 3", "%ld %lu", &read[0], &read[1]);
  return read[2] == 5 ? static_cast<int>(read[0]) * value : 0;
}
