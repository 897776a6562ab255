// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_ALGOBASE_H
#define BTR_OPENR_OLD_ALGOBASE_H

#include <algorithm>

using std::copy;
using std::copy_backward;
using std::equal;
using std::fill;
using std::fill_n;
using std::iter_swap;
using std::lexicographical_compare;
using std::max;
using std::min;
using std::mismatch;
using std::pair;
using std::swap;

#endif
