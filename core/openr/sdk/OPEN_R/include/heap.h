// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_HEAP_H
#define BTR_OPENR_OLD_HEAP_H

#include <algorithm>

using std::make_heap;
using std::pop_heap;
using std::push_heap;
using std::sort_heap;

#endif
