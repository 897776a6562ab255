// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_SET_H
#define BTR_OPENR_OLD_SET_H

#include <set>

using namespace std;

#endif
