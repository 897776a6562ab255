// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_ALGO_H
#define BTR_OPENR_OLD_ALGO_H

#include <algorithm>

using namespace std;

#endif
