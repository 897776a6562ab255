#include <stdio.h>
#include <stdlib.h>
#include <Types.h>
#include "Old.h"
static counter = 0;
int old_sum(a, b)
  int a, b;
{
  counter++;
  return a + b;
}
void say(text) char* text; { printf("old c: %s %d\n", text, counter); }
void scanned() {
  struct { longword word; int guard; long wide; short narrow; } r;
  char name[8];
  double real;
  int count = 0, all;
  r.guard = 99;
  r.wide = -1;
  all = sscanf("4000000000 -5 2.5 x 3", "%lu %ld %lf %7s %hd%n", &r.word, &r.wide, &real, name, &r.narrow, &count);
  printf("scanned %d: %u %d %ld %g %s %d, %d characters\n", all, r.word, r.guard, r.wide, real, name, r.narrow, count);
  printf("none %d, longest %ld\n", sscanf("abc", "abc"), strtol("99999999999", 0, 10));
}
implicit(x) { return undeclared(x); }
undeclared(x) { return x; }
