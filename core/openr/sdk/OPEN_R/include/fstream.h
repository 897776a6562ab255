// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_FSTREAM_H
#define BTR_OPENR_OLD_FSTREAM_H

#include <fstream>

#include <iostream.h>

using std::filebuf;
using std::fstream;
using std::ifstream;
using std::ofstream;
using std::streambuf;

#endif
