// The name that this header had before the standard.
#ifndef BTR_OPENR_OLD_FSTREAM_H
#define BTR_OPENR_OLD_FSTREAM_H

#include <fstream>

using namespace std;

#endif
