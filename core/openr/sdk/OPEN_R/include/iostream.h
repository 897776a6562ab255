// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_IOSTREAM_H
#define BTR_OPENR_OLD_IOSTREAM_H

#include <iostream>

using namespace std;

#endif
