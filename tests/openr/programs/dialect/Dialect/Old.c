#include <stdio.h>
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
implicit(x) { return undeclared(x); }
undeclared(x) { return x; }
