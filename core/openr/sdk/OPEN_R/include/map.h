// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_MAP_H
#define BTR_OPENR_OLD_MAP_H

#include <map>

using namespace std;

#endif
