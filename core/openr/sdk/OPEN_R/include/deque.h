// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_DEQUE_H
#define BTR_OPENR_OLD_DEQUE_H

#include <deque>

using namespace std;

#endif
