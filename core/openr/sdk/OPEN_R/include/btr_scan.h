/* scanf() and its kin. On the robot a `long` had 32 bits, and programs read a longword by "%ld"; here "%ld" would write
   64. So each integer is read as wide as the variable that it goes to. */
#ifndef BTR_OPENR_SCAN_H
#define BTR_OPENR_SCAN_H

#include <stdarg.h>

#define BTR_OPENR_SCAN_ROOM 512

static inline int btr_scan_is(char c, const char* one) {
  while (*one != 0 && *one != c) ++one;
  return *one != 0;
}

/* `format` with the modifier of each integer that its variable needs, in `own`; itself if it is too long for that.
   `widths`: bytes of what each argument points to; what is neither 4 nor 8 is left as it is written. */
static inline const char* btr_scan_format(const char* format, const unsigned char* widths, int count, char* own) {
  char* to = own;
  const char* at = format;
  int next = 0;
  if (__builtin_strlen(format) >= BTR_OPENR_SCAN_ROOM / 2) return format;
  while (*at != 0) {
    int assigned, integer, narrow, width;
    const char* modifier;
    if ((*to++ = *at++) != '%') continue;
    assigned = *at != '*' && *at != '%';
    while (*at == '*' || (*at >= '0' && *at <= '9')) *to++ = *at++;
    modifier = at;
    while (btr_scan_is(*at, "hlLqjzt")) ++at;
    integer = btr_scan_is(*at, "diouxXn");
    narrow = *modifier == 'h';
    width = assigned && next < count ? widths[next] : 0;
    if (integer && !narrow && width == 8) {
      *to++ = 'l';
    } else if (!(integer && !narrow && width == 4)) {
      while (modifier != at) *to++ = *modifier++;
    }
    if (assigned) ++next;
    if (*at == '[') { /* up to its end, which may stand first in it */
      *to++ = *at++;
      if (*at == '^') *to++ = *at++;
      if (*at == ']') *to++ = *at++;
      while (*at != 0 && *at != ']') *to++ = *at++;
    }
    if (*at != 0) *to++ = *at++;
  }
  *to = 0;
  return own;
}

#ifdef __cplusplus

extern "C" {
int btr_c_fscanf(FILE* from, const char* format, ...) __asm__("fscanf");
int btr_c_sscanf(const char* from, const char* format, ...) __asm__("sscanf");
int btr_c_scanf(const char* format, ...) __asm__("scanf");
}

extern "C++" {

/// Bytes of what an argument of scanf() points to; 0: not known, or text.
template <class T>
inline unsigned char btr_scan_width(T* const&) {
  return sizeof(T) == 4 || sizeof(T) == 8 ? sizeof(T) : 0;
}
inline unsigned char btr_scan_width(...) { return 0; }

#define BTR_OPENR_SCAN_FORMAT                                       \
  const unsigned char widths[] = {btr_scan_width(arguments)..., 0}; \
  char own[BTR_OPENR_SCAN_ROOM];                                    \
  const char* const now = btr_scan_format(format, widths, (int)sizeof...(Arguments), own)

// Preferred to the C library's, which take anything.
template <class... Arguments>
inline int fscanf(FILE* from, const char* format, Arguments... arguments) {
  BTR_OPENR_SCAN_FORMAT;
  return btr_c_fscanf(from, now, arguments...);
}
template <class... Arguments>
inline int sscanf(const char* from, const char* format, Arguments... arguments) {
  BTR_OPENR_SCAN_FORMAT;
  return btr_c_sscanf(from, now, arguments...);
}
template <class... Arguments>
inline int scanf(const char* format, Arguments... arguments) {
  BTR_OPENR_SCAN_FORMAT;
  return btr_c_scanf(now, arguments...);
}
namespace std {
using ::fscanf;
using ::scanf;
using ::sscanf;
}  // namespace std

#undef BTR_OPENR_SCAN_FORMAT

}  // extern "C++"

#else

/* `widths` begins with those of the arguments that stand before the variables. */
static inline int btr_fscanf(const unsigned char* widths, int count, FILE* from, const char* format, ...) {
  char own[BTR_OPENR_SCAN_ROOM];
  va_list arguments;
  int got;
  va_start(arguments, format);
  got = vfscanf(from, btr_scan_format(format, widths + 2, count - 2, own), arguments);
  va_end(arguments);
  return got;
}
static inline int btr_sscanf(const unsigned char* widths, int count, const char* from, const char* format, ...) {
  char own[BTR_OPENR_SCAN_ROOM];
  va_list arguments;
  int got;
  va_start(arguments, format);
  got = vsscanf(from, btr_scan_format(format, widths + 2, count - 2, own), arguments);
  va_end(arguments);
  return got;
}
static inline int btr_scanf(const unsigned char* widths, int count, const char* format, ...) {
  char own[BTR_OPENR_SCAN_ROOM];
  va_list arguments;
  int got;
  va_start(arguments, format);
  got = vfscanf(stdin, btr_scan_format(format, widths + 1, count - 1, own), arguments);
  va_end(arguments);
  return got;
}

/* A list of 2 to 32 arguments is a call with variables; one argument or none a call without, or a declaration. */
#define BTR_OPENR_WIDTH(pointer) (sizeof(*(pointer)) == 4 || sizeof(*(pointer)) == 8 ? sizeof(*(pointer)) : 0)
#define BTR_OPENR_EACH_1(x) BTR_OPENR_WIDTH(x)
#define BTR_OPENR_EACH_2(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_1(__VA_ARGS__)
#define BTR_OPENR_EACH_3(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_2(__VA_ARGS__)
#define BTR_OPENR_EACH_4(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_3(__VA_ARGS__)
#define BTR_OPENR_EACH_5(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_4(__VA_ARGS__)
#define BTR_OPENR_EACH_6(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_5(__VA_ARGS__)
#define BTR_OPENR_EACH_7(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_6(__VA_ARGS__)
#define BTR_OPENR_EACH_8(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_7(__VA_ARGS__)
#define BTR_OPENR_EACH_9(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_8(__VA_ARGS__)
#define BTR_OPENR_EACH_10(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_9(__VA_ARGS__)
#define BTR_OPENR_EACH_11(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_10(__VA_ARGS__)
#define BTR_OPENR_EACH_12(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_11(__VA_ARGS__)
#define BTR_OPENR_EACH_13(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_12(__VA_ARGS__)
#define BTR_OPENR_EACH_14(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_13(__VA_ARGS__)
#define BTR_OPENR_EACH_15(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_14(__VA_ARGS__)
#define BTR_OPENR_EACH_16(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_15(__VA_ARGS__)
#define BTR_OPENR_EACH_17(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_16(__VA_ARGS__)
#define BTR_OPENR_EACH_18(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_17(__VA_ARGS__)
#define BTR_OPENR_EACH_19(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_18(__VA_ARGS__)
#define BTR_OPENR_EACH_20(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_19(__VA_ARGS__)
#define BTR_OPENR_EACH_21(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_20(__VA_ARGS__)
#define BTR_OPENR_EACH_22(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_21(__VA_ARGS__)
#define BTR_OPENR_EACH_23(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_22(__VA_ARGS__)
#define BTR_OPENR_EACH_24(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_23(__VA_ARGS__)
#define BTR_OPENR_EACH_25(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_24(__VA_ARGS__)
#define BTR_OPENR_EACH_26(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_25(__VA_ARGS__)
#define BTR_OPENR_EACH_27(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_26(__VA_ARGS__)
#define BTR_OPENR_EACH_28(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_27(__VA_ARGS__)
#define BTR_OPENR_EACH_29(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_28(__VA_ARGS__)
#define BTR_OPENR_EACH_30(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_29(__VA_ARGS__)
#define BTR_OPENR_EACH_31(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_30(__VA_ARGS__)
#define BTR_OPENR_EACH_32(x, ...) BTR_OPENR_WIDTH(x), BTR_OPENR_EACH_31(__VA_ARGS__)
#define BTR_OPENR_PICK(a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18, a19, a20, a21, \
                       a22, a23, a24, a25, a26, a27, a28, a29, a30, a31, a32, picked, ...)                             \
  picked
#define BTR_OPENR_COUNT(...)                                                                                          \
  BTR_OPENR_PICK(__VA_ARGS__, 32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14, 13, 12, 11, \
                 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define BTR_OPENR_KIND(...)                                                                                            \
  BTR_OPENR_PICK(__VA_ARGS__, many, many, many, many, many, many, many, many, many, many, many, many, many, many,      \
                 many, many, many, many, many, many, many, many, many, many, many, many, many, many, many, many, many, \
                 one, 0)
#define BTR_OPENR_JOIN_(a, b) a##b
#define BTR_OPENR_JOIN(a, b) BTR_OPENR_JOIN_(a, b)
#define BTR_OPENR_WIDTHS(...) \
  (const unsigned char[]) { BTR_OPENR_JOIN(BTR_OPENR_EACH_, BTR_OPENR_COUNT(__VA_ARGS__))(__VA_ARGS__) }
#define BTR_OPENR_SCAN_one(name, ...) (name)(__VA_ARGS__)
#define BTR_OPENR_SCAN_many(name, ...) \
  btr_##name((BTR_OPENR_WIDTHS(__VA_ARGS__)), BTR_OPENR_COUNT(__VA_ARGS__), __VA_ARGS__)
#define fscanf(...) BTR_OPENR_JOIN(BTR_OPENR_SCAN_, BTR_OPENR_KIND(__VA_ARGS__))(fscanf, __VA_ARGS__)
#define sscanf(...) BTR_OPENR_JOIN(BTR_OPENR_SCAN_, BTR_OPENR_KIND(__VA_ARGS__))(sscanf, __VA_ARGS__)
#define scanf(...) BTR_OPENR_JOIN(BTR_OPENR_SCAN_, BTR_OPENR_KIND(__VA_ARGS__))(scanf, __VA_ARGS__)

#endif

#endif
