// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_QUEUE_H
#define BTR_OPENR_OLD_QUEUE_H

#include <queue>

using namespace std;

#endif
