// On the robot a size_t and the sizes in vectors were one type, of 32 bits; here they are two, and still are compared.
#ifndef BTR_OPENR_SIZES_H
#define BTR_OPENR_SIZES_H

#include <stddef.h>

extern "C++" {
namespace std {

inline size_t min(size_t a, unsigned int b) { return a < b ? a : b; }
inline size_t min(unsigned int a, size_t b) { return a < b ? a : b; }
inline size_t max(size_t a, unsigned int b) { return a > b ? a : b; }
inline size_t max(unsigned int a, size_t b) { return a > b ? a : b; }

}  // namespace std
}

#endif
