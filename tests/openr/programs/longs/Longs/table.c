#include <stdio.h>
struct entry {
  unsigned long key;
};
void in_c(text, number) char* text;
long number;
{
#ifndef __MIPSEL__
#error "in which order do bytes lie?"
#endif
  sprintf(text, "%d %ld", (int)sizeof(struct entry), number);
}
