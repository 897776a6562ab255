// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_QUEUE_H
#define BTR_OPENR_OLD_QUEUE_H

#include <queue>

using std::priority_queue;
using std::queue;

#endif
