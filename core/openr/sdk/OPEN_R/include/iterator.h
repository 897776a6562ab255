// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_ITERATOR_H
#define BTR_OPENR_OLD_ITERATOR_H

#include <iterator>

using std::advance;
using std::back_inserter;
using std::distance;
using std::front_inserter;
using std::inserter;
using std::istream_iterator;
using std::iterator;
using std::ostream_iterator;
using std::reverse_iterator;

#endif
