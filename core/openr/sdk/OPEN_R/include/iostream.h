// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_IOSTREAM_H
#define BTR_OPENR_OLD_IOSTREAM_H

#include <iostream>

using std::cerr;
using std::cin;
using std::clog;
using std::cout;
using std::endl;
using std::ends;
using std::flush;
using std::ios;
using std::iostream;
using std::istream;
using std::ostream;
using std::streambuf;
using std::streamoff;
using std::streampos;
using std::ws;

#endif
