#include <stdio.h>
struct entry {
  unsigned long key;
};
void in_c(text, number) char* text;
long number;
{ sprintf(text, "%d %ld", (int)sizeof(struct entry), number); }
