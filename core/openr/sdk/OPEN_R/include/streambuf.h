// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_STREAMBUF_H
#define BTR_OPENR_OLD_STREAMBUF_H

#include <streambuf>

using std::streambuf;

#endif
