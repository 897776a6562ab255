#ifndef DEEPER_H
#define DEEPER_H
struct Deeper {
  static int twice(int value);
};
#endif
