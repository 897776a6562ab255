// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_STRSTREAM_H
#define BTR_OPENR_OLD_STRSTREAM_H

#include <strstream>

using namespace std;

#endif
