// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_STRSTREAM_H
#define BTR_OPENR_OLD_STRSTREAM_H

#include <strstream>

#include <iostream.h>

using std::istrstream;
using std::ostrstream;
using std::strstream;
using std::strstreambuf;

#endif
