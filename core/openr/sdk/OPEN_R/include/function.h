// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_FUNCTION_H
#define BTR_OPENR_OLD_FUNCTION_H

#include <functional>

using namespace std;

#endif
