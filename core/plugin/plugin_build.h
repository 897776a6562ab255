#pragma once
// How a module was compiled: what must be the same in a plugin and in the program, because objects of the C++ library
// and of Eigen pass between them and because a trial must give the same bits.
#include <Eigen/Core>
#include <cstddef>
#include <string>

namespace btr {

struct PluginBuild {
  const char* compiler;    ///< __VERSION__
  const char* library;     ///< the C++ library and its binary interface
  const char* eigen;       ///< version and alignment
  const char* arithmetic;  ///< options that change results
  const char* checks;      ///< sanitizers
  std::size_t layout;      ///< sizes of what passes between them, as the headers at hand say
};

/// What differs, as the end of a sentence that begins with the module: "was compiled by …, this program by …"; "" if
/// nothing does.
std::string differenceOf(const PluginBuild& module, const PluginBuild& program);

}  // namespace btr

#define BTR_TEXT_(x) #x
#define BTR_TEXT(x) BTR_TEXT_(x)

#if defined(_LIBCPP_VERSION)
#define BTR_CXX_LIBRARY "libc++ " BTR_TEXT(_LIBCPP_VERSION)
#elif defined(_GLIBCXX_DEBUG)
#define BTR_CXX_LIBRARY                                            \
  "libstdc++ " BTR_TEXT(_GLIBCXX_RELEASE) ", CXX11_ABI=" BTR_TEXT( \
      _GLIBCXX_USE_CXX11_ABI) ", debug containers (-D_GLIBCXX_DEBUG)"
#else
#define BTR_CXX_LIBRARY "libstdc++ " BTR_TEXT(_GLIBCXX_RELEASE) ", CXX11_ABI=" BTR_TEXT(_GLIBCXX_USE_CXX11_ABI)
#endif

#define BTR_EIGEN \
  "Eigen " BTR_TEXT(EIGEN_WORLD_VERSION) "." BTR_TEXT(EIGEN_MAJOR_VERSION) "." BTR_TEXT(EIGEN_MINOR_VERSION) ", " \
      "alignment up to " BTR_TEXT(EIGEN_MAX_ALIGN_BYTES) " bytes"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#define BTR_ARITHMETIC_A "inexact (-ffast-math)"
#else
#define BTR_ARITHMETIC_A "exact"
#endif
#if defined(__FMA__)
#define BTR_ARITHMETIC_B " with fused multiply-add (-mfma, -march)"
#else
#define BTR_ARITHMETIC_B ""
#endif

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define BTR_CHECKS "AddressSanitizer"
#endif
#endif
#if !defined(BTR_CHECKS) && defined(__SANITIZE_ADDRESS__)
#define BTR_CHECKS "AddressSanitizer"
#endif
#if !defined(BTR_CHECKS)
#define BTR_CHECKS "no sanitizer"
#endif

/// Of the file that is being compiled. A macro: an inline variable would be shared between module and program.
#define BTR_PLUGIN_BUILD                                                                                      \
  btr::PluginBuild {                                                                                          \
    __VERSION__, BTR_CXX_LIBRARY, BTR_EIGEN, BTR_ARITHMETIC_A BTR_ARITHMETIC_B, BTR_CHECKS, btr::pluginLayout \
  }
