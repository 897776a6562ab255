#include "sum.h"
long sum_of(values, count) const longword* values;
int count;
{
  long sum = 0;
  while (count--) sum += *values++;
  return sum;
}
