#include "deeper.h"
int Deeper::twice(int value) { return 2 * value; }
