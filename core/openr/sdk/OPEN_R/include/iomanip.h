// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_IOMANIP_H
#define BTR_OPENR_OLD_IOMANIP_H

#include <iomanip>

using namespace std;

#endif
