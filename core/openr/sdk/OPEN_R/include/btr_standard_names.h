// Included before a source that does not compile without: compilers before the standard had the library's names
// everywhere.
#ifndef BTR_OPENR_STANDARD_NAMES_H
#define BTR_OPENR_STANDARD_NAMES_H
#ifdef __cplusplus
#include <bits/stl_algobase.h> /* min() and max() of any type, beside those of btr_sizes.h */
namespace std {}
using namespace std;
#endif
#endif
