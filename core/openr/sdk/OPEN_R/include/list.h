// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_LIST_H
#define BTR_OPENR_OLD_LIST_H

#include <list>

using namespace std;

#endif
