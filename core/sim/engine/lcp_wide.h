#pragma once
#include <cstdint>

namespace btr {

// Four numbers at once, whatever the processor makes of it: the same operations in the same order, so the same bits.
constexpr unsigned wideLanes = 4;
typedef double Four __attribute__((vector_size(32), may_alias, aligned(8)));
typedef std::uint64_t FourBits __attribute__((vector_size(32), may_alias, aligned(8)));
static_assert(sizeof(Four) == wideLanes * sizeof(double));
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define BTR_WIDE [[gnu::target_clones("avx2", "default")]]
#else
#define BTR_WIDE
#endif
// Small enough to be put where they are used, in each processor's version of the loops around them.
#define BTR_INLINE [[gnu::always_inline]] inline
// Before a loop of six rows: written out, whatever the compiler's level of optimisation.
#if defined(__GNUC__) && !defined(__clang__)
#define BTR_UNROLL _Pragma("GCC unroll 6")
#else
#define BTR_UNROLL
#endif

}  // namespace btr
