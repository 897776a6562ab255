// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_DEQUE_H
#define BTR_OPENR_OLD_DEQUE_H

#include <deque>

using std::deque;

#endif
