// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_VECTOR_H
#define BTR_OPENR_OLD_VECTOR_H

#include <vector>

using namespace std;

#endif
