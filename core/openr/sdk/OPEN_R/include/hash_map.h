// The name that this header had before the standard: what it declares is known without std, as in 2003.
#ifndef BTR_OPENR_OLD_HASH_MAP_H
#define BTR_OPENR_OLD_HASH_MAP_H

#include <ext/hash_map>

using __gnu_cxx::hash;
using __gnu_cxx::hash_map;
using __gnu_cxx::hash_multimap;

#endif
