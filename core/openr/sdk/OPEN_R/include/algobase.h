// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_ALGOBASE_H
#define BTR_OPENR_OLD_ALGOBASE_H

#include <algorithm>

using std::swap;
using std::iter_swap;
using std::min;
using std::max;
using std::copy;
using std::copy_backward;
using std::fill;
using std::fill_n;
using std::equal;
using std::mismatch;
using std::lexicographical_compare;
using std::pair;

#endif
