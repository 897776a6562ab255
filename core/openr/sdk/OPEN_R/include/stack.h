// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_STACK_H
#define BTR_OPENR_OLD_STACK_H

#include <stack>

using namespace std;

#endif
