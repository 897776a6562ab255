// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_IOMANIP_H
#define BTR_OPENR_OLD_IOMANIP_H

#include <iomanip>

#include <iostream.h>

using std::dec;
using std::endl;
using std::ends;
using std::flush;
using std::hex;
using std::oct;
using std::resetiosflags;
using std::setbase;
using std::setfill;
using std::setiosflags;
using std::setprecision;
using std::setw;
using std::ws;

#endif
